// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/safety.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

Safety::Safety(double max_force, double max_power, double max_speed, int hold_steps) noexcept
    : max_force_(max_force),
      max_power_(max_power),
      max_speed_(max_speed),
      hold_steps_(hold_steps) {}

Admission Safety::admit(const DeviceSample& sample, const Eigen::Vector3d& velocity) noexcept {
  if (held_ > 0) --held_;
  if (forgiven_ > 0 && --forgiven_ == 0) missed_ = 0;
  if (!sample.ok) {
    forgiven_ = kForgiven;
    if (held_ == 0 && ++missed_ <= kMostMissed) return Admission::paused;
    trip(Trip::no_reading);
  } else if (sample.watchdog && !sample.released_at) {
    trip(Trip::watchdog);
  } else if (!sample.position.allFinite() || !velocity.allFinite()) {
    trip(Trip::not_finite);
  } else if (velocity.norm() > max_speed_) {
    trip(Trip::overspeed);
  }
  return held_ == 0 && sample.enabled ? Admission::shown : Admission::cut;
}

double Safety::scale(const Eigen::Vector3d& wanted, const Eigen::Vector3d& velocity) noexcept {
  if (!wanted.allFinite()) {
    trip(Trip::not_finite);
    return 0.0;
  }
  const double size = wanted.norm();
  const double power = wanted.dot(velocity);
  const double by_force = size > max_force_ ? max_force_ / size : 1.0;
  return power > max_power_ ? std::min(by_force, max_power_ / power) : by_force;
}

// A lasting cause keeps the force at zero but counts once.
void Safety::trip(Trip cause) noexcept {
  if (held_ == 0 || cause != last_) ++trips_;
  last_ = cause;
  held_ = hold_steps_;
}

}  // namespace reckon::haptics
