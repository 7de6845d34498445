// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/kinematic_state.hpp"

#include <cmath>

namespace reckon::deadreckon {

bool is_finite(const KinematicState& state) noexcept {
  // Negated form, so that a NaN norm fails too.
  const bool unit = std::abs(state.orientation.norm() - 1.0) <= 1e-6;
  return unit && state.position.allFinite() && state.velocity.allFinite() &&
         state.acceleration.allFinite() && state.angular_velocity.allFinite();
}

bool is_finite(const Pose& pose) noexcept {
  return pose.position.allFinite() && pose.orientation.coeffs().allFinite() &&
         pose.velocity.allFinite() && pose.angular_velocity.allFinite();
}

}  // namespace reckon::deadreckon
