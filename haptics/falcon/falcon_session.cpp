// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_session.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/haptics/falcon/falcon_kinematics.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint8_t kAllHomed = 7;
constexpr std::uint8_t kGreen = 2, kBlue = 4, kRed = 8;
constexpr double kWordsPerTorque = -1e4;  // [1/(N m)]
constexpr double kMostWord = 32767.0;
// [m/rad]: beyond it a motor's word could not hold the largest force.
constexpr double kLongestLever = 0.3;
// A torque is computed for where the handle will be in the middle of its being held.
constexpr double kAhead = 1.5;
constexpr double kBelievedTurn = 0.05;  // [rad], that is believed of an exchange

std::uint8_t light_of(FalconStage stage, bool servo_silent) noexcept {
  if (stage == FalconStage::homing) return kBlue;
  return stage == FalconStage::running && !servo_silent ? kGreen : kRed;
}

}  // namespace

void FalconSession::take(std::span<const std::uint8_t> octets, nanoseconds now) noexcept {
  for (const std::uint8_t octet : octets) {
    const auto report = parser_.take(octet);
    if (!report || !awaiting_) continue;
    awaiting_ = false;
    heard_at_ = now;
    if (stage_ == FalconStage::running && timed_ < kTimed) {
      longest_ = std::max(longest_, now - sent_at_);
      ++timed_;
    }
    answer(*report);
  }
}

void FalconSession::answer(const FalconReport& report) noexcept {
  const std::int64_t before = held_;
  held_ = sent_;
  if (report.homed != kAllHomed) return leave(FalconStage::homing);
  Eigen::Vector3d angles;
  for (int i = 0; i < 3; ++i) angles[i] = falcon_angle(report.counts[static_cast<std::size_t>(i)]);
  const auto pose = falcon_pose(angles);
  if (!pose || !(pose->jacobian.norm() < kLongestLever)) return leave(FalconStage::outside);

  const bool joins = stage_ == FalconStage::running;
  turn_.setZero();
  if (joins) turn_ = (angles - angles_).cwiseMin(kBelievedTurn).cwiseMax(-kBelievedTurn);
  angles_ = angles;
  jacobian_ = pose->jacobian;
  stage_ = FalconStage::running;
  if (servo_silent_) return;
  FalconReading reading;
  reading.position = device_place(pose->position);
  reading.before = before;
  reading.after = sent_;
  reading.run = run_;
  reading.buttons = report.buttons;
  exchange_.readings.push(reading);
}

// The force is dropped with the next command, and no reading joins those before.
void FalconSession::leave(FalconStage stage) noexcept {
  if (stage_ == FalconStage::running) ++run_;
  stage_ = stage;
}

std::optional<FalconCommand> FalconSession::next(nanoseconds now) noexcept {
  FalconCommand command;
  if (awaiting_) {
    if (!is_late(now)) return std::nullopt;
    ++late_;
    leave(FalconStage::silent);
    awaiting_ = false;
    deaf_until_ = now + kPause;
    parser_.restart();
    command.lights = kRed;
    return command;
  }
  if (now < deaf_until_) return std::nullopt;

  exchange_.force.update();
  const FalconForce& newest = exchange_.force.read();
  const bool silent = newest.number == 0 || now - newest.at > kSilence;
  if (silent && !servo_silent_) ++run_;
  servo_silent_ = silent;
  command.lights = light_of(stage_, silent);
  command.homing = stage_ == FalconStage::homing;
  if (stage_ == FalconStage::running && !silent) command.motors = motors();
  sent_ = newest.number;
  sent_at_ = now;
  awaiting_ = true;
  return command;
}

std::array<std::int16_t, 3> FalconSession::motors() const noexcept {
  const auto ahead = falcon_pose(angles_ + kAhead * turn_);
  const Eigen::Matrix3d& jacobian = ahead ? ahead->jacobian : jacobian_;
  const Eigen::Vector3d force = falcon_axes(exchange_.force.read().force);
  const Eigen::Vector3d words = kWordsPerTorque * falcon_torques(jacobian, force);
  std::array<std::int16_t, 3> motors{};
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const double word = std::clamp(words[static_cast<Eigen::Index>(i)], -kMostWord, kMostWord);
    motors[i] = static_cast<std::int16_t>(std::lround(word));
  }
  return motors;
}

}  // namespace reckon::haptics
