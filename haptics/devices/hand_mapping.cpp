// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/hand_mapping.hpp"

namespace reckon::haptics {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d mirrored(const Vector3d& vector) noexcept { return {-vector.x(), vector.y(), vector.z()}; }

// A mirror M maps an axial vector v to -M v.
Vector3d mirrored_turn(const Vector3d& vector) noexcept {
  return {vector.x(), -vector.y(), -vector.z()};
}

// M R M is a rotation by the same angle about the mirrored axis in the opposite direction.
Quaterniond mirrored(const Quaterniond& orientation) noexcept {
  return {orientation.w(), orientation.x(), -orientation.y(), -orientation.z()};
}

DeviceLimits mapped(DeviceLimits limits, const HandMapping& mapping) noexcept {
  const double scale = mapping.scale, square = scale * scale;
  limits.max_force /= scale;
  limits.max_stiffness /= square;
  limits.damping /= square;
  limits.lever *= scale;
  limits.max_speed *= scale;
  limits.resolution *= scale;
  const Vector3d from = scale * limits.workspace_min, to = scale * limits.workspace_max;
  limits.workspace_min = from;
  limits.workspace_max = to;
  if (mapping.mirrored) {
    limits.workspace_min.x() = -to.x();
    limits.workspace_max.x() = -from.x();
  }
  return limits;
}

}  // namespace reckon::haptics
