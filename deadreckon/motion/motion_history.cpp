// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/motion_history.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::deadreckon {

bool is_finite(const MotionSample& s) noexcept {
  return std::isfinite(s.time) && s.position.allFinite() && s.orientation.coeffs().allFinite() &&
         s.velocity.allFinite() && s.acceleration.allFinite() && s.angular_velocity.allFinite();
}

MotionSample motion_sample(const KinematicState& state, double time) noexcept {
  const DrmTerms terms = drm_terms(state.algorithm);
  MotionSample sample{time, state.position, state.orientation, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  if (terms.rotation) sample.angular_velocity = state.angular_velocity;
  if (terms.velocity)
    sample.velocity = terms.body_axes ? state.orientation * state.velocity : state.velocity;

  // Body components change at A_b, and their axes rotate: a = A_b + w x v.
  Eigen::Vector3d a = terms.acceleration ? state.acceleration : Eigen::Vector3d(0, 0, 0);
  if (terms.body_axes) {
    if (terms.rotation) a += state.angular_velocity.cross(state.velocity);
    a = state.orientation * a;
  }
  sample.acceleration = a;
  return sample;
}

KinematicState kinematic_state(const MotionSample& sample,
                               pdu::DeadReckoningAlgorithm algorithm) noexcept {
  const DrmTerms terms = drm_terms(algorithm);
  KinematicState state;
  state.algorithm = algorithm;
  state.position = sample.position;
  state.orientation = sample.orientation;
  if (terms.velocity) state.velocity = sample.velocity;
  if (terms.acceleration) state.acceleration = sample.acceleration;
  if (terms.rotation) state.angular_velocity = sample.angular_velocity;
  if (!terms.body_axes) return state;

  const Eigen::Quaterniond to_body = sample.orientation.conjugate();
  state.velocity = to_body * state.velocity;
  if (terms.acceleration)
    state.acceleration =
        to_body * state.acceleration - state.angular_velocity.cross(state.velocity);
  return state;
}

bool MotionHistory::add(const MotionSample& sample) noexcept {
  if (!is_finite(sample)) return false;
  if (size_ > 0 && sample.time < samples_[0].time) return false;
  if (size_ == 0 || sample.time > samples_[0].time) {
    std::shift_right(samples_.begin(), samples_.end(), 1);
    size_ = std::min(size_ + 1, kLength);
  }
  samples_[0] = sample;
  return true;
}

}  // namespace reckon::deadreckon
