// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/virtual_handle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

// Greatest credit, in loans: work of the hand on the device beyond its work on the mass.
constexpr double kMostSaved = 4.0;
constexpr double kLighter = 0.5 * std::numbers::ln2;  // [1/s]

void require(bool holds, const char* what, double value) {
  if (!holds) throw std::invalid_argument(std::string(what) + ", not " + std::to_string(value));
}

}  // namespace

VirtualHandle::VirtualHandle(MotionDevice& device, const VirtualHandleConfig& config)
    : device_(device), limits_(device.limits()), config_(config), mass_(config.mass) {
  require(config.mass > 0, "the virtual mass must be above 0 kg", config.mass);
  require(config.damping > 0, "the virtual damping must be above 0 N s/m", config.damping);
  require(config.loan >= 0, "the loan must be 0 or more J", config.loan);
  require(config.hold > nanoseconds(0) && config.hold <= kWatchdog,
          "a force must be held for more than 0 and at most 0.01 s", pdu::to_seconds(config.hold));
}

DeviceLimits VirtualHandle::limits() const noexcept {
  DeviceLimits limits;
  limits.max_force =
      config_.max_force > 0 ? std::min(config_.max_force, limits_.max_force) : limits_.max_force;
  limits.damping = config_.damping;
  limits.max_speed = 1.01 * limits_.max_speed;  // the mass is never faster than the device
  limits.workspace_min = limits_.workspace_min;
  limits.workspace_max = limits_.workspace_max;
  return limits;
}

// Sets the mass at rest at the device's position, without a force of the scene.
void VirtualHandle::stand(const MotionSample& sample, bool is_good) noexcept {
  if (force_.squaredNorm() > 0) released_ = position_;
  velocity_.setZero();
  force_.setZero();
  if (!is_good) return;
  position_ = device_at_ = sample.position;
  hand_ = sample.force;
}

DeviceSample VirtualHandle::read(nanoseconds now) noexcept {
  const MotionSample sample = device_.read(now);
  DeviceSample out;
  out.ok = sample.ok && sample.position.allFinite() && sample.force.allFinite();
  out.enabled = sample.enabled;
  out.buttons = sample.buttons;
  const nanoseconds elapsed = now - read_at_;
  read_at_ = now;
  const Eigen::Vector3d hand = 0.5 * (hand_ + sample.force);
  if (out.ok && was_good_) owed_ -= hand.dot(sample.position - device_at_);
  was_good_ = out.ok;
  if (!out.ok || !sample.enabled || !moves_ || elapsed > kWatchdog) {
    stand(sample, out.ok);
    moves_ = out.ok && sample.enabled;
  } else {
    device_at_ = sample.position;
    hand_ = sample.force;
    const nanoseconds held =
        std::clamp(written_at_ + config_.hold - (now - elapsed), nanoseconds(0), elapsed);
    move(hand, pdu::to_seconds(held));
    if (held < elapsed) {
      if (force_.squaredNorm() > 0) released_ = position_;
      force_.setZero();
      move(hand, pdu::to_seconds(elapsed - held));
    }
  }
  owed_ = std::max(owed_, -kMostSaved * config_.loan);
  if (moves_) device_.command(position_, velocity_, now);
  if (out.ok && released_) {
    out.watchdog = true;
    out.released_at = std::exchange(released_, std::nullopt);
  }
  out.position = position_;
  out.velocity = velocity_;
  out.has_velocity = true;
  return out;
}

void VirtualHandle::move(const Eigen::Vector3d& hand, double dt) noexcept {
  if (!(dt > 0)) return;
  mass_ = std::max(config_.mass, mass_ * std::exp(-kLighter * dt));
  const double rate = config_.damping / mass_;
  const double lost = -std::expm1(-rate * dt);  // lost share of the velocity
  const Eigen::Vector3d steady = (hand + force_) / config_.damping;
  Eigen::Vector3d step = steady * dt + (velocity_ - steady) * (lost / rate);
  velocity_ += (steady - velocity_) * lost;

  // A factor that shortens the displacement reduces the velocity as much.
  double share = 1.0;
  const double fastest = limits_.max_speed;
  const double speed = std::max(velocity_.norm(), step.norm() / dt);
  if (speed > fastest) share = fastest / speed;
  const double work = hand.dot(step);
  const bool beyond = work > 0 && owed_ + share * work > config_.loan;
  if (beyond) share = std::clamp((config_.loan - owed_) / work, 0.0, share);
  step *= share;
  velocity_ *= share;
  for (int axis = 0; axis < 3; ++axis) {
    // From outside, only motion inwards is possible.
    const double to = std::clamp(position_[axis] + step[axis],
                                 std::min(limits_.workspace_min[axis], position_[axis]),
                                 std::max(limits_.workspace_max[axis], position_[axis]));
    if (to != position_[axis] + step[axis]) velocity_[axis] = 0.0;
    step[axis] = to - position_[axis];
  }
  position_ += step;
  owed_ += hand.dot(step);
  if (beyond && 2.0 * mass_ <= kMostHeavy * config_.mass) {
    mass_ *= 2.0;
    velocity_ *= 0.5;
    written_off_ += owed_;
    owed_ = 0.0;
    heavier_.fetch_add(1, std::memory_order_relaxed);
  }
}

void VirtualHandle::write(const Eigen::Vector3d& force, nanoseconds now) noexcept {
  written_at_ = now;
  force_ = force.allFinite() && moves_ ? force : Eigen::Vector3d::Zero();
}

}  // namespace reckon::haptics
