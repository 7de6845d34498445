// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/safety.hpp"

#include <algorithm>
#include <utility>

namespace reckon::haptics {

Safety::Safety(double max_force, double max_power, double max_speed, int hold_steps) noexcept
    : max_force_(max_force),
      max_power_(max_power),
      max_speed_(max_speed),
      hold_steps_(hold_steps) {}

Admission Safety::admit(const DeviceSample& sample, const Eigen::Vector3d& velocity) noexcept {
  return admit(sample, velocity.allFinite(), velocity.norm() > max_speed_);
}

Admission Safety::admit(const DeviceSample& sample, const Wrench& twist) noexcept {
  return admit(sample, twist.allFinite(),
               twist.head<3>().norm() > max_speed_ || twist.tail<3>().norm() > max_turn_);
}

Admission Safety::admit(const DeviceSample& sample, bool finite, bool fast) noexcept {
  heat_.pass(std::exchange(showing_, 0.0));
  if (held_ > 0) --held_;
  if (forgiven_ > 0 && --forgiven_ == 0) missed_ = 0;
  if (!sample.ok) {
    forgiven_ = kForgiven;
    if (held_ == 0 && ++missed_ <= kMostMissed) return Admission::paused;
    trip(Trip::no_reading);
  } else if (sample.watchdog && !sample.released_at) {
    trip(Trip::watchdog);
  } else if (!sample.position.allFinite() || !finite) {
    trip(Trip::not_finite);
  } else if (fast) {
    trip(Trip::overspeed);
  }
  const bool shows = held_ == 0 && sample.enabled;
  shown_ = shows ? std::min(shown_ + 1, kRampSteps) : 0;
  return shows ? Admission::shown : Admission::cut;
}

// @param excess ratio of force or torque to its limit
double Safety::within_limits(double excess, double power) noexcept {
  const double most = std::min(static_cast<double>(shown_) / kRampSteps, heat_.most());
  double scale = excess > most ? most / excess : 1.0;
  if (power > max_power_) scale = std::min(scale, max_power_ / power);
  showing_ = scale * excess;
  return scale;
}

double Safety::scale(const Eigen::Vector3d& wanted, const Eigen::Vector3d& velocity) noexcept {
  if (!wanted.allFinite()) {
    trip(Trip::not_finite);
    return 0.0;
  }
  return within_limits(wanted.norm() / max_force_, wanted.dot(velocity));
}

double Safety::scale(const Wrench& wanted, const Wrench& twist) noexcept {
  if (!wanted.allFinite()) {
    trip(Trip::not_finite);
    return 0.0;
  }
  const double excess =
      std::max(wanted.head<3>().norm() / max_force_, wanted.tail<3>().norm() / max_torque_);
  return within_limits(excess, wanted.dot(twist));
}

// A lasting cause keeps the force at zero but counts once.
void Safety::trip(Trip cause) noexcept {
  if (held_ == 0 || cause != last_) ++trips_;
  last_ = cause;
  held_ = hold_steps_;
}

}  // namespace reckon::haptics
