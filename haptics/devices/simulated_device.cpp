// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/simulated_device.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr double kLongestSubstep = 1e-4;  // [s]
constexpr nanoseconds kLongestRun{1'000'000'000};

}  // namespace

SimulatedDevice::SimulatedDevice(const SimulatedDeviceConfig& config, HandScript script,
                                 TurnScript turns)
    : config_(config),
      script_(std::move(script)),
      turns_(std::move(turns)),
      position_(config.start) {
  require_of_simulated(config.mass > 0, "mass must be above 0 kg", config.mass);
  require_of_simulated(config.damping >= 0, "damping must be 0 or more N s/m", config.damping);
  require_of_simulated(config.friction >= 0, "dry friction must be 0 or more N", config.friction);
  require_of_simulated(config.hand_stiffness >= 0, "hand stiffness must be 0 or more N/m",
                       config.hand_stiffness);
  require_of_simulated(config.hand_damping >= 0, "hand damping must be 0 or more N s/m",
                       config.hand_damping);
  require_of_simulated(config.max_force > 0, "largest force must be above 0 N", config.max_force);
  require_of_simulated(config.max_stiffness >= 0, "largest stiffness must be 0 or more N/m",
                       config.max_stiffness);
  require_of_simulated(config.delay_samples >= 0 && config.delay_samples <= kMostDelay,
                       "delay must be 0 to 1000 samples", config.delay_samples);
  require_of_simulated(config.hold > nanoseconds(0) && config.hold <= kWatchdog,
                       "a force must be held for more than 0 and at most 0.01 s",
                       pdu::to_seconds(config.hold));
  require_of_simulated(config.resolution >= 0, "resolution must be 0 or more m", config.resolution);
  if (config.turn) turn_.emplace(*config.turn);
  under_way_.assign(static_cast<std::size_t>(config.delay_samples), Wrench::Zero());
}

DeviceLimits SimulatedDevice::limits() const noexcept {
  DeviceLimits limits;
  limits.max_force = config_.max_force;
  limits.damping = config_.damping;
  limits.max_speed = config_.max_speed;
  limits.max_stiffness = config_.max_stiffness;
  limits.delay_samples = config_.delay_samples;
  limits.resolution = config_.resolution;
  limits.workspace_min = config_.workspace.min();
  limits.workspace_max = config_.workspace.max();
  if (turn_) {
    limits.axes = 6;
    limits.max_torque = turn_->config().max_torque;
    limits.turn_damping = turn_->config().damping;
    limits.turn_resolution = turn_->config().resolution;
  }
  return limits;
}

void SimulatedDevice::plug(bool in) noexcept {
  plugged_ = in;
  if (!in) drop_force();
}

void SimulatedDevice::drop_force() noexcept {
  force_.setZero();
  torque_.setZero();
  for (Wrench& wrench : under_way_) wrench.setZero();
}

void SimulatedDevice::restart(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                              nanoseconds now) noexcept {
  if (started_) time_ += pdu::to_seconds(std::max(now - read_at_, nanoseconds(0)));
  started_ = true;
  read_at_ = written_at_ = now;
  drop_force();
  position_ = position;
  velocity_ = velocity;
  if (turn_) turn_->restart(turn_->orientation(), turn_->rate());
  port_work_ = damping_loss_ = hand_work_ = 0.0;
}

bool SimulatedDevice::holds_force() const noexcept {
  const auto some = [](const auto& force) { return force.squaredNorm() > 0; };
  return some(force_) || some(torque_) || std::any_of(under_way_.begin(), under_way_.end(), some);
}

DeviceSample SimulatedDevice::read(nanoseconds now) noexcept {
  if (!started_) {
    started_ = true;
    read_at_ = written_at_ = now;
  }
  DeviceSample sample;
  const nanoseconds elapsed = std::min(now - read_at_, kLongestRun);
  const nanoseconds deadline = written_at_ + config_.hold;
  if (now > deadline && holds_force()) {
    const nanoseconds held = std::clamp(deadline - read_at_, nanoseconds(0), elapsed);
    run(pdu::to_seconds(held));
    drop_force();
    sample.watchdog = true;
    sample.released_at = position_;
    if (turn_) sample.released_turned = turn_->orientation();
    run(pdu::to_seconds(elapsed - held));
  } else {
    run(pdu::to_seconds(elapsed));
  }
  read_at_ = now;

  sample.ok = plugged_;
  sample.enabled = enabled_;
  sample.buttons = buttons_ | scripted_;
  sample.position = position_;
  sample.velocity = velocity_;
  sample.has_velocity = config_.resolution <= 0;
  const double step = config_.resolution;
  if (step > 0) sample.position = (position_ / step).array().round().matrix() * step;
  if (turn_) {
    sample.turn = {turn_->reading(), turn_->rate()};
    sample.has_velocity = sample.has_velocity && turn_->config().resolution <= 0;
  }
  return sample;
}

void SimulatedDevice::write(const Eigen::Vector3d& force, nanoseconds now) noexcept {
  written_at_ = now;
  if (!plugged_ || !force.allFinite()) return drop_force();
  if (under_way_.empty()) {
    force_ = force;
    return;
  }
  Wrench& next = under_way_[next_];
  force_ = next.head<3>();
  next.head<3>() = force;
  next_ = next_ + 1 == under_way_.size() ? 0 : next_ + 1;
}

void SimulatedDevice::write_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& torque,
                                   nanoseconds now) noexcept {
  if (!torque.allFinite()) return drop_force();
  torque_ = torque;
  if (!under_way_.empty()) {
    torque_ = under_way_[next_].tail<3>();
    under_way_[next_].tail<3>() = torque;
  }
  write(force, now);
}

void SimulatedDevice::run(double duration) noexcept {
  if (!(duration > 0)) return;
  const double steps = std::max(1.0, std::ceil(duration / kLongestSubstep - 1e-9));
  const double h = duration / steps;
  if (turn_) run_turn(static_cast<int>(steps), h);
  for (int i = 0; i < static_cast<int>(steps); ++i) substep(h);
}

// Rotation and translation are independent while force and torque are held.
void SimulatedDevice::run_turn(int steps, double h) noexcept {
  DeviceTurn target{turn_->config().start, Eigen::Vector3d::Zero()};
  for (int i = 0; i < steps; ++i) {
    const double time = time_ + i * h;
    if (turns_) target = turns_(time);
    const double grip = script_ ? script_(time).grip : 1.0;
    turn_->step(torque_, target.orientation, target.rate, grip, h);
  }
}

// Semi-implicit Euler: velocity first. All energies use the velocity that moves the handle, so
// damping * |dx|^2 / dt never exceeds the loss booked here (Cauchy-Schwarz).
void SimulatedDevice::substep(double h) noexcept {
  HandTarget target;
  target.position = config_.start;
  if (script_) target = script_(time_);
  scripted_ = target.buttons;
  Eigen::Vector3d pull = config_.hand_stiffness * (target.position - position_);
  const double pulls = pull.norm();
  if (pulls > target.most_pull) pull *= target.most_pull / pulls;
  const Eigen::Vector3d hand =
      target.grip * (pull + config_.hand_damping * (target.velocity - velocity_)) + target.push;
  velocity_ += h / config_.mass * (hand + force_ - config_.damping * velocity_);
  const double rubs = h / config_.mass * config_.friction, speed = velocity_.norm();
  if (rubs > 0) velocity_ *= speed > rubs ? 1.0 - rubs / speed : 0.0;
  const Eigen::Vector3d dx = h * velocity_;
  position_ += dx;
  time_ += h;
  port_work_ -= force_.dot(dx);
  hand_work_ += hand.dot(dx);
  damping_loss_ += config_.damping * velocity_.dot(dx);
}

}  // namespace reckon::haptics
