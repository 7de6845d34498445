// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/pointer_device.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace reckon::haptics {
namespace {

constexpr double kPathShare = 0.4;   // of the device's greatest speed
constexpr double kPullShare = 0.5;   // of its greatest force
constexpr double kSpeedShare = 0.5;  // of its greatest speed, which the pull adds to the path's

Eigen::AlignedBox3d box_about(const Eigen::Vector3d& start, double reach) {
  if (!(reach > 0)) {
    throw std::invalid_argument("pointer device: reach must be above 0 m, got " +
                                std::to_string(reach));
  }
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(reach);
  return {Eigen::Vector3d(start - half), Eigen::Vector3d(start + half)};
}

// A handle that F pulls along a path of speed u reaches (F + c u) / (b + c).
double pull_of(const SimulatedDeviceConfig& config) {
  if (!(config.hand_damping > 0)) {
    throw std::invalid_argument("pointer device: hand damping must be above 0 N s/m, got " +
                                std::to_string(config.hand_damping));
  }
  return std::min(kPullShare * config.max_force,
                  kSpeedShare * config.max_speed * (config.damping + config.hand_damping));
}

}  // namespace

PointerDevice::PointerDevice(const SimulatedDeviceConfig& config, double reach, HandScript course)
    : SimulatedDevice(config, [this](double time) { return target_at(time); }),
      course_(std::move(course)),
      path_(box_about(config.start, reach), config.start, kPathShare * config.max_speed),
      most_pull_(pull_of(config)) {}

DeviceLimits PointerDevice::limits() const noexcept {
  DeviceLimits limits = SimulatedDevice::limits();
  limits.workspace_min = path_.box().min();
  limits.workspace_max = path_.box().max();
  return limits;
}

DeviceSample PointerDevice::read(std::chrono::nanoseconds now) noexcept {
  if (inbox_.take()) grip_.take(inbox_.sample().held);
  const DeviceSample sample = SimulatedDevice::read(now);
  inbox_.tell(grip_.holds());
  return sample;
}

HandTarget PointerDevice::target_at(double time) noexcept {
  const double h = time - time_;
  time_ = time;
  grip_.advance(h);
  lead();
  path_.advance(h);
  HandTarget target;
  target.position = path_.position();
  target.velocity = path_.velocity();
  target.grip = grip_.share();
  target.most_pull = most_pull_;
  target.buttons = grip_.holds() && inbox_.sample().grabs ? 1 : 0;
  return target;
}

// While the grip fades, the path comes to rest; then it follows the hand.
void PointerDevice::lead() noexcept {
  if (course_ && !grip_.holds() && grip_.since() > kAlone) grip_.rest();
  if (grip_.rests()) {
    if (course_) path_.lead_to(course_(time_).position);
  } else if (grip_.holds()) {
    path_.lead_to(inbox_.sample().position);
  } else if (grip_.share() > 0) {
    path_.rest();
  } else {
    path_.lead_to(position());
  }
}

}  // namespace reckon::haptics
