// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/extrapolators/multi_step.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Vector3d;

// Position and velocity after t seconds at this velocity and acceleration.
Pose along(const MotionSample& from, const Vector3d& velocity, const Vector3d& acceleration,
           double t) {
  return {from.position + t * velocity + (0.5 * t * t) * acceleration, from.orientation,
          velocity + t * acceleration, Vector3d::Zero()};
}

void turn(Pose& pose, const Vector3d& angular_velocity, double t) {
  pose.orientation = pose.orientation * exponential(t * angular_velocity);
  pose.angular_velocity = angular_velocity;
}

Pose one_step(const MotionHistory& history, const Vector3d& acceleration, double tau) {
  const double t = bounded_tau(tau);
  Pose pose = along(history[0], history[0].velocity, acceleration, t);
  turn(pose, history[0].angular_velocity, t);
  return pose;
}

// Angular velocity from the two newest orientations, for less than half a turn between them.
Vector3d turn_rate(const MotionHistory& history, double gap) {
  return logarithm(history[1].orientation.conjugate() * history[0].orientation) / gap;
}

}  // namespace

double usable_gap(const MotionHistory& history, const StepLimits& limits) noexcept {
  if (history.size() < 2) return 0;
  const double gap = history[0].time - history[1].time;
  return gap >= limits.shortest_gap ? gap : 0;
}

Pose hold(const MotionHistory& history, double, const StepLimits&) noexcept {
  if (history.size() == 0) return {};
  return {history[0].position, history[0].orientation, Vector3d::Zero(), Vector3d::Zero()};
}

Pose first_order_one_step(const MotionHistory& history, double tau, const StepLimits&) noexcept {
  if (history.size() == 0) return {};
  return one_step(history, Vector3d::Zero(), tau);
}

Pose second_order_one_step(const MotionHistory& history, double tau, const StepLimits&) noexcept {
  if (history.size() == 0) return {};
  return one_step(history, history[0].acceleration, tau);
}

Pose first_order_two_step(const MotionHistory& history, double tau,
                          const StepLimits& limits) noexcept {
  const double gap = usable_gap(history, limits);
  if (gap == 0) return first_order_one_step(history, tau, limits);
  const double t = std::min(bounded_tau(tau), limits.most_gaps * gap);
  const bool holding = t < tau;
  Pose pose =
      along(history[0], (history[0].position - history[1].position) / gap, Vector3d::Zero(), t);
  turn(pose, turn_rate(history, gap), t);
  if (holding) pose.velocity = pose.angular_velocity = Vector3d::Zero();
  return pose;
}

Pose second_order_two_step(const MotionHistory& history, double tau,
                           const StepLimits& limits) noexcept {
  const double gap = usable_gap(history, limits);
  if (gap == 0) return first_order_one_step(history, tau, limits);
  const double t = bounded_tau(tau);
  const double accelerated = std::min(t, limits.most_gaps * gap);
  const Vector3d acceleration = (history[0].velocity - history[1].velocity) / gap;
  Pose pose = along(history[0], history[0].velocity, acceleration, accelerated);
  pose.position += (t - accelerated) * pose.velocity;  // the sent velocity continues
  turn(pose, turn_rate(history, gap), accelerated);
  if (accelerated < t) pose.angular_velocity = Vector3d::Zero();
  return pose;
}

Pose third_order_two_step(const MotionHistory& history, double tau,
                          const StepLimits& limits) noexcept {
  const double gap = usable_gap(history, limits);
  if (gap == 0) return second_order_one_step(history, tau, limits);
  Pose pose = one_step(history, history[0].acceleration, tau);
  const double t = std::min(bounded_tau(tau), limits.most_gaps * gap);
  const double after = bounded_tau(tau) - t;  // after it the velocity from the jerk continues
  const Vector3d jerk = (history[0].acceleration - history[1].acceleration) / gap;
  const Vector3d velocity = (0.5 * t * t) * jerk;
  pose.position += (t * t * t / 6) * jerk + after * velocity;
  pose.velocity += velocity;
  return pose;
}

}  // namespace reckon::deadreckon
