// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/falcon_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "reckon/haptics/falcon/falcon_kinematics.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;
using haptics::FalconGeometry;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kOctet = nanoseconds(6'667);    // at 1.5 Mbaud
constexpr nanoseconds kWatchdog = milliseconds(100);  // its own
constexpr std::uint16_t kRunBaud = 2;                 // as in its program
constexpr std::size_t kPacket = 62;                   // octets, beside two of status

// Frame D in the Falcon's own axes, in which the model moves.
Vector3d turned(const Vector3d& v_D) { return {v_D.x(), v_D.z(), -v_D.y()}; }
Vector3d place(const Vector3d& p_D) {
  return turned(p_D) + Vector3d(0, 0, FalconGeometry::kMiddle);
}

}  // namespace

FalconModel::FalconModel(const FalconModelOptions& options, std::function<Vector3d(double)> hand)
    : HeldModel(options, std::move(hand)),
      options_(options),
      random_(options.seed),
      has_firmware_(options.has_firmware),
      homed_(options.homed) {
  begin();
}

Vector3d FalconModel::torques() const {
  Vector3d torques;
  for (int i = 0; i < 3; ++i) torques[i] = -1e-4 * motors_[static_cast<std::size_t>(i)];
  return torques;
}

Vector3d FalconModel::half_steps() const { return Vector3d::Constant(0.5e-4); }

std::optional<HeldModel::Joints> FalconModel::joints_at(const Vector3d& position) const {
  const auto angles = haptics::falcon_angles(place(position));
  if (!angles) return std::nullopt;
  // The slope of the closed form: the driver's conversion from angles to a position may give
  // another solution.
  constexpr double kStep = 1e-7;  // [m]
  Joints joints{*angles, Eigen::Matrix3d::Zero()};
  Eigen::Matrix3d turning;
  for (int i = 0; i < 3; ++i) {
    const auto there = haptics::falcon_angles(place(position + kStep * Vector3d::Unit(i)));
    if (!there) return joints;
    turning.col(i) = (*there - *angles) / kStep;
  }
  if (std::abs(turning.determinant()) > 0) joints.jacobian = turning.inverse();
  return joints;
}

void FalconModel::forget() {
  has_firmware_ = homed_ = loading_ = false;
  motors_ = {};
  command_.clear();
  loaded_.clear();
  greeting_.clear();
  forget_line();
}

void FalconModel::forget_line() {
  to_device_.clear();
  to_host_.clear();
  packets_.clear();
  latency_ = 16;
  baud_ = 0;
}

void FalconModel::run_line() {
  if (now_ - obeyed_at_ > kWatchdog) motors_ = {};
  while (!to_device_.empty() && to_device_.front().first <= now_) {
    const std::uint8_t octet = to_device_.front().second;
    to_device_.pop_front();
    if (!has_firmware_) {
      echo(octet);
    } else if (baud_ == kRunBaud) {
      take(octet);
    }
  }
  const bool tick = now_ >= next_tick_;
  if (tick) {
    const nanoseconds every = milliseconds(std::max(1, latency_));
    const auto offset = nanoseconds(static_cast<std::int64_t>(1e6 * options_.tick_at));
    next_tick_ = ((now_ - offset) / every + 1) * every + offset;
  }
  std::size_t due = 0;
  while (due < to_host_.size() && to_host_[due].first <= now_) ++due;
  if (splits_ && due > 1 && tick) due = 1 + random_() % (due - 1);
  if (!tick && due < kPacket) return;
  std::vector<std::uint8_t> packet{0x01, 0x60};
  for (std::size_t i = 0; i < std::min(due, kPacket); ++i) {
    packet.push_back(to_host_.front().second);
    to_host_.pop_front();
  }
  // Without a reader the chip keeps one packet of status.
  if (packet.size() == 2 && !packets_.empty()) return;
  packets_.push_back(std::move(packet));
}

void FalconModel::take(std::uint8_t octet) {
  if (octet == '<') command_.clear();
  command_ += static_cast<char>(octet);
  if (octet != '>') return;
  if (command_.size() == 16) obey();
  command_.clear();
}

void FalconModel::obey() {
  ++commands_;
  obeyed_at_ = now_;
  for (std::size_t arm = 0; arm < 3; ++arm) {
    unsigned word = 0;
    for (std::size_t i = 4; i-- > 0;)
      word = word << 4 | static_cast<unsigned>(command_[1 + 4 * arm + i] - 'A');
    motors_[arm] = static_cast<std::int16_t>(word);
  }
  if (now_ >= mute_until_) report();
}

void FalconModel::report() {
  std::string text = "<";
  for (int arm = 0; arm < 3; ++arm) {
    const auto count =
        static_cast<std::uint16_t>(homed_ ? haptics::falcon_count(angles_[arm]) : std::int16_t{77});
    for (int i = 0; i < 4; ++i) text += static_cast<char>('A' + (count >> (4 * i) & 15));
  }
  text += static_cast<char>('A' + (homed_ ? 0x70 : 0x20) + 4);
  text += "A>";
  nanoseconds at = now_;
  for (char c : text) {
    if (damaged_ > 0 && random_() % 3 == 0) {
      c = is_visible_ ? '~' : static_cast<char>(random_());
      --damaged_;
    }
    at += kOctet;
    to_host_.emplace_back(at, static_cast<std::uint8_t>(c));
  }
}

// Without firmware it answers a greeting, and then echoes its input.
void FalconModel::echo(std::uint8_t octet) {
  const auto say = [&](std::string_view text) {
    for (const char c : text) to_host_.emplace_back(now_, static_cast<std::uint8_t>(c));
  };
  if (!loading_) {
    greeting_ += static_cast<char>(octet);
    if (baud_ == 0x4138 && greeting_.ends_with("\x0A\x43\x0D")) say("\x0A\x44\x2C\x0D");
    if (baud_ == 0x15 && greeting_.ends_with("\x41")) {
      say("\x41");
      loading_ = true;
    }
    return;
  }
  loaded_.push_back(octet);
  if (damaged_ > 0) {
    octet = static_cast<std::uint8_t>(octet + 1);
    --damaged_;
  }
  to_host_.emplace_back(now_, octet);
}

int FalconModel::control(std::uint8_t request, std::uint16_t value,
                         std::span<std::uint8_t> answer) {
  if (request == 0 && std::exchange(stalls_, false)) return -EPIPE;
  if (request == 3) {
    baud_ = value;
    // The loader starts the received program when the line's speed becomes that program's.
    if (value == 2 && loading_) {
      loading_ = false;
      has_firmware_ = loaded_ == options_.firmware;
      loaded_.clear();
    }
  }
  if (request == 9) latency_ = options_.latency_set >= 0 ? options_.latency_set : value;
  if (request == 10 && !answer.empty()) {
    answer[0] = static_cast<std::uint8_t>(latency_);
    return 1;
  }
  if (request == 0 && value == 1) {
    to_host_.clear();
    packets_.clear();
  }
  return 0;
}

void FalconModel::take_transfer(std::span<const std::uint8_t> octets) {
  nanoseconds at = now_;
  for (const std::uint8_t octet : octets) to_device_.emplace_back(at += kOctet, octet);
}

std::optional<int> FalconModel::in_done(std::span<std::uint8_t> octets) {
  if (packets_.empty() || now_ < hangs_until_) return std::nullopt;
  const std::vector<std::uint8_t> packet = std::move(packets_.front());
  packets_.pop_front();
  std::ranges::copy(packet, octets.begin());
  return static_cast<int>(packet.size());
}

std::vector<std::uint8_t> FalconModel::descriptors() const {
  return {18,   1,    0x00, 0x02, 0,    0,    0,    64,   0x03,
          0x04, 0x48, 0xCB, 0x00, 0x04, 0,    0,    0,    1,   // device
          9,    2,    32,   0,    1,    1,    0,    0x80, 45,  // configuration
          9,    4,    0,    0,    2,    0xFF, 0xFF, 0xFF, 0,   // interface
          7,    5,    0x81, 2,    64,   0,    0,               // in
          7,    5,    0x02, 2,    64,   0,    0};              // out
}

}  // namespace reckon::test
