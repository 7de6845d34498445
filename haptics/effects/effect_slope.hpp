// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Forces of surface slopes that are too small to be shapes.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "reckon/haptics/effects/effect_hooks.hpp"

namespace reckon::haptics {

/// Share with which waves of `length` [m] are rendered by samples `way` [m] apart: 1 for four
/// samples per wave or more, 0 below two, which would give noise.
[[nodiscard]] inline double shown_of_waves(double length, double way) noexcept {
  return way > 0.0 ? std::clamp(0.5 * length / way - 1.0, 0.0, 1.0) : 1.0;
}

/// The force of a slope on a small ball [N, S]: the normal force times the slope, downhill along
/// the surface. @param slope gradient of the height, in the object's axes @param contact in contact
[[nodiscard]] inline Eigen::Vector3d slope_force(const EffectContact& contact,
                                                 const Eigen::Vector3d& slope) noexcept {
  const Eigen::Vector3d uphill = contact.object->axes * slope;
  return -contact.normal_force() * (uphill - contact.normal.dot(uphill) * contact.normal);
}

}  // namespace reckon::haptics
