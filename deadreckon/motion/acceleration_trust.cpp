// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/acceleration_trust.hpp"

#include <limits>

namespace reckon::deadreckon {
namespace {

// The state after `t` seconds, with its acceleration scaled by `share` from then on.
KinematicState moved_on(const KinematicState& state, double t, double share) {
  const Pose pose = extrapolate(state, t);
  const bool body_axes = drm_terms(state.algorithm).body_axes;
  KinematicState next = state;
  next.position = pose.position;
  next.orientation = pose.orientation;
  next.velocity =
      body_axes ? Eigen::Vector3d(pose.orientation.conjugate() * pose.velocity) : pose.velocity;
  next.acceleration = share * state.acceleration;
  return next;
}

}  // namespace

double acceleration_trust(const KinematicState& state) noexcept {
  const double change = state.acceleration.norm();
  if (!drm_terms(state.algorithm).acceleration || change == 0)
    return std::numeric_limits<double>::infinity();
  return kTrustedChange * state.velocity.norm() / change;
}

bool is_beyond_trust(const KinematicState& state, double tau) noexcept {
  if (!drm_terms(state.algorithm).acceleration || !(tau > 0)) return false;
  const double t = bounded_tau(tau);
  return t * t * state.acceleration.squaredNorm() >
         kTrustedChange * kTrustedChange * state.velocity.squaredNorm();
}

Pose extrapolate_trusted(const KinematicState& state, double tau) noexcept {
  if (!is_beyond_trust(state, tau)) return extrapolate(state, tau);
  const double trust = acceleration_trust(state);
  const double after = bounded_tau(tau) - trust;
  const KinematicState back = moved_on(state, trust, -1.0);
  if (!(after > trust)) return extrapolate(back, after);
  KinematicState steady = moved_on(back, trust, 0.0);
  steady.velocity = state.velocity;  // removes the rounding errors of both phases
  return extrapolate(steady, after - trust);
}

}  // namespace reckon::deadreckon
