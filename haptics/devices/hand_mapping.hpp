// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Maps the motion of a handle to the motion of its hand: scale, mirror and clutch.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// Mapping from handle to hand.
struct HandMapping {
  /// Displacement of the hand per displacement of the handle, > 0. Rotations are not scaled.
  double scale = 1.0;
  /// Swaps left and right: mirrors at the plane of the device's y and z axes.
  bool mirrored = false;
  /// Bit number in DeviceSample::buttons, 0 to 31. While the button is down, the handle moves and
  /// the hand does not. std::nullopt: no clutch.
  std::optional<int> clutch_button{};

  [[nodiscard]] bool is_plain() const noexcept {
    return scale == 1.0 && !mirrored && !clutch_button;
  }
};

/// Mirrors a polar vector: position, velocity, force.
[[nodiscard]] inline Eigen::Vector3d mirrored(const Eigen::Vector3d& vector) noexcept {
  return {-vector.x(), vector.y(), vector.z()};
}
/// Mirrors an axial vector: turn rate, torque.
[[nodiscard]] inline Eigen::Vector3d mirrored_turn(const Eigen::Vector3d& vector) noexcept {
  // A mirror M maps an axial vector v to -M v.
  return {vector.x(), -vector.y(), -vector.z()};
}
[[nodiscard]] inline Eigen::Quaterniond mirrored(const Eigen::Quaterniond& orientation) noexcept {
  // M R M is a rotation by the same angle about the mirrored axis in the opposite direction.
  return {orientation.w(), orientation.x(), -orientation.y(), -orientation.z()};
}

/// The limits of a device in the hand's scale. The power is the same on both sides, so the force is
/// divided by the scale, and stiffness and damping by its square.
[[nodiscard]] inline DeviceLimits mapped(DeviceLimits limits, const HandMapping& mapping) noexcept {
  const double scale = mapping.scale, square = scale * scale;
  limits.max_force /= scale;
  limits.max_stiffness /= square;
  limits.damping /= square;
  limits.lever *= scale;
  limits.max_speed *= scale;
  limits.resolution *= scale;
  const Eigen::Vector3d from = scale * limits.workspace_min, to = scale * limits.workspace_max;
  limits.workspace_min = from;
  limits.workspace_max = to;
  if (mapping.mirrored) {
    limits.workspace_min.x() = -to.x();
    limits.workspace_max.x() = -from.x();
  }
  return limits;
}

}  // namespace reckon::haptics
