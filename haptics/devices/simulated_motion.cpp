// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/simulated_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kMotionSubstep = 5e-5;  // [s]
constexpr nanoseconds kLongestMotion{1'000'000'000};
// A velocity loop corrects its position error in four times its time constant.
constexpr double kCorrection = 0.25;

}  // namespace

SimulatedMotion::SimulatedMotion(const SimulatedMotionConfig& config, HandScript script)
    : config_(config),
      script_(std::move(script)),
      position_(config.start),
      hand_(config.start),
      command_{config.start, Vector3d::Zero()} {
  require_of_simulated(config.bandwidth > 0, "bandwidth must be above 0 Hz", config.bandwidth);
  require_of_simulated(config.mass > 0, "mass must be above 0 kg", config.mass);
  require_of_simulated(config.sensor_stiffness > 0, "stiffness of the sensor must be above 0 N/m",
                       config.sensor_stiffness);
  require_of_simulated(config.sensor_damping > 0, "damping of the sensor must be above 0 N s/m",
                       config.sensor_damping);
  require_of_simulated(config.hand_mass > 0, "mass of the hand must be above 0 kg",
                       config.hand_mass);
  require_of_simulated(config.hand_stiffness >= 0, "hand stiffness must be 0 or more N/m",
                       config.hand_stiffness);
  require_of_simulated(config.hand_damping >= 0, "hand damping must be 0 or more N s/m",
                       config.hand_damping);
  require_of_simulated(config.max_force > 0, "largest force must be above 0 N", config.max_force);
  require_of_simulated(config.max_speed > 0, "largest speed must be above 0 m/s", config.max_speed);
  require_of_simulated(config.delay_samples >= 0 && config.delay_samples <= kMostDelay,
                       "delay must be 0 to 100 samples", config.delay_samples);
  under_way_.assign(static_cast<std::size_t>(config.delay_samples), command_);
}

MotionLimits SimulatedMotion::limits() const noexcept {
  return {config_.max_force, config_.max_speed, config_.workspace.min(), config_.workspace.max()};
}

MotionSample SimulatedMotion::read(nanoseconds now) noexcept {
  if (!started_) read_at_ = now;
  started_ = true;
  const nanoseconds elapsed = std::min(now - read_at_, kLongestMotion);
  const nanoseconds deadline = commanded_at_ + HapticDevice::kWatchdog;
  const nanoseconds driven = commanded_ && plugged_
                                 ? std::clamp(deadline - (now - elapsed), nanoseconds(0), elapsed)
                                 : nanoseconds(0);
  run(pdu::to_seconds(driven), true);
  run(pdu::to_seconds(elapsed - driven), false);
  read_at_ = now;

  MotionSample sample;
  sample.position = position_;
  sample.force = force_;
  sample.ok = plugged_;
  sample.enabled = enabled_;
  sample.buttons = buttons_;
  return sample;
}

void SimulatedMotion::command(const Vector3d& position, const Vector3d& velocity,
                              nanoseconds now) noexcept {
  if (!position.allFinite() || !velocity.allFinite()) return;
  commanded_at_ = now;
  commanded_ = true;
  command_ = {position, velocity};
  if (under_way_.empty()) return;
  std::swap(command_, under_way_[next_]);
  next_ = next_ + 1 == under_way_.size() ? 0 : next_ + 1;
}

void SimulatedMotion::run(double duration, bool driven) noexcept {
  if (!(duration > 0)) return;
  const double steps = std::max(1.0, std::ceil(duration / kMotionSubstep - 1e-9));
  for (int i = 0; i < static_cast<int>(steps); ++i) substep(duration / steps, driven);
}

// Semi-implicit Euler. The forces of hand and sensor use the state before the step.
void SimulatedMotion::substep(double h, bool driven) noexcept {
  HandTarget target;
  target.position = config_.start;
  if (script_) target = script_(time_);
  buttons_ = target.buttons;
  Vector3d pull = config_.hand_stiffness * (target.position - hand_);
  const double pulls = pull.norm();
  if (pulls > target.most_pull) pull *= target.most_pull / pulls;
  const Vector3d wants =
      target.grip * (pull + config_.hand_damping * (target.velocity - hand_velocity_)) +
      target.push;
  force_ = config_.sensor_stiffness * (hand_ - position_) +
           config_.sensor_damping * (hand_velocity_ - velocity_);
  hand_velocity_ += h / config_.hand_mass * (wants - force_);

  const double fast = 2.0 * std::numbers::pi * config_.bandwidth;  // [rad/s]
  Vector3d drive = -fast * velocity_;                              // brakes
  if (driven && config_.loop == MotionLoop::position) {
    drive = fast * fast * (command_.position - position_) +
            2.0 * fast * (command_.velocity - velocity_);
  } else if (driven) {
    drive = fast *
            (command_.velocity + kCorrection * fast * (command_.position - position_) - velocity_);
  }
  if (driven) command_.position += h * command_.velocity;  // extrapolated until the next command
  velocity_ += h * (drive + force_ / config_.mass);
  const Vector3d step = h * velocity_;
  position_ += step;
  hand_ += h * hand_velocity_;
  time_ += h;
  handle_work_ += force_.dot(step);
}

}  // namespace reckon::haptics
