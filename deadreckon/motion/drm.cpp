// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/drm.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/motion/turn_series.hpp"

namespace reckon::deadreckon {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

TurnTerms closed_terms(double square) {
  const double angle = std::sqrt(square);
  const double s = std::sin(0.5 * angle);
  const double c = std::cos(0.5 * angle);
  const double f1 = 2.0 * s * c / angle;
  const double h1 = 2.0 * s * s / square;  // 1 - cos u as 2 sin^2(u/2)
  const double g1 = (1.0 - f1) / square;
  const double f2 = f1 - h1;
  return {f1, h1, g1, f2, h1 - g1, (0.5 - f2) / square, c, s / angle};
}

TurnTerms turn_terms(const Vector3d& turn) {
  const double square = turn.squaredNorm();
  return square < kSeriesAngle * kSeriesAngle ? series_terms(square) : closed_terms(square);
}

Pose extrapolate_reference(const KinematicState& s, const DrmTerms& terms, double t) {
  Pose pose{s.position, s.orientation, Vector3d::Zero(), Vector3d::Zero()};
  if (terms.velocity) {
    pose.position += t * s.velocity;
    pose.velocity = s.velocity;
  }
  if (terms.acceleration) {
    pose.position += (0.5 * t * t) * s.acceleration;
    pose.velocity += t * s.acceleration;
  }
  if (terms.rotation) {
    pose.orientation = s.orientation * exponential(t * s.angular_velocity);
    pose.angular_velocity = s.angular_velocity;
  }
  return pose;
}

// FPB and FVB: the frame does not rotate, so R1 = t I and R2 = t^2/2 I.
Pose extrapolate_fixed_body(const KinematicState& s, const DrmTerms& terms, double t) {
  Vector3d way = t * s.velocity;
  Vector3d velocity = s.velocity;
  if (terms.acceleration) {
    way += (0.5 * t * t) * s.acceleration;
    velocity += t * s.acceleration;
  }
  return {s.position + s.orientation * way, s.orientation, s.orientation * velocity,
          Vector3d::Zero()};
}

Pose extrapolate_turning_body(const KinematicState& s, const DrmTerms& terms, double t,
                              AccelerationReading reading) {
  const Vector3d turn = t * s.angular_velocity;
  const TurnTerms k = turn_terms(turn);
  Vector3d velocity = s.velocity;
  Vector3d way = t * (k.f1 * s.velocity + k.h1 * turn.cross(s.velocity) +
                      (k.g1 * turn.dot(s.velocity)) * turn);
  if (terms.acceleration) {
    Vector3d a = s.acceleration;
    if (reading == AccelerationReading::inertial) a -= s.angular_velocity.cross(s.velocity);
    way += (t * t) * (k.f2 * a + k.h2 * turn.cross(a) + (k.g2 * turn.dot(a)) * turn);
    velocity += t * a;
  }
  Quaterniond step;
  step.w() = k.half_cosine;
  step.vec() = k.half_sine_over_angle * turn;
  const Quaterniond orientation = s.orientation * step;
  return {s.position + s.orientation * way, orientation, orientation * velocity,
          s.angular_velocity};
}

}  // namespace

double bounded_tau(double tau) noexcept {
  if (std::isnan(tau)) return 0;
  return std::clamp(tau, -kLongestExtrapolation, kLongestExtrapolation);
}

bool stands_still(const KinematicState& state) noexcept {
  const DrmTerms terms = drm_terms(state.algorithm);
  return (!terms.velocity || state.velocity.isZero(0)) &&
         (!terms.acceleration || state.acceleration.isZero(0)) &&
         (!terms.rotation || state.angular_velocity.isZero(0));
}

Pose extrapolate(const KinematicState& state, double tau, AccelerationReading reading) noexcept {
  const DrmTerms terms = drm_terms(state.algorithm);
  const double t = bounded_tau(tau);
  if (!terms.body_axes) return extrapolate_reference(state, terms, t);
  if (!terms.rotation) return extrapolate_fixed_body(state, terms, t);
  return extrapolate_turning_body(state, terms, t, reading);
}

}  // namespace reckon::deadreckon
