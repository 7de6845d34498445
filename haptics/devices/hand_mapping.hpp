// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Between the axes of a device and the axes in which its hand moves: scale, mirror and clutch.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// How the motion of a handle becomes that of its hand.
struct HandMapping {
  /// Ways of the hand for one of the handle, above 0. Turns are not scaled.
  double scale = 1.0;
  /// Left and right change sides: the plane of the device's y and z axes is a mirror.
  bool mirrored = false;
  /// Bit number of DeviceSample::buttons, 0 to 31: while it is down the handle moves, and the hand
  /// does not; none: no clutch.
  std::optional<int> clutch_button{};

  [[nodiscard]] bool is_plain() const noexcept {
    return scale == 1.0 && !mirrored && !clutch_button;
  }
};

/// Of a mirrored axis pair: a vector that points somewhere (place, velocity, force).
[[nodiscard]] Eigen::Vector3d mirrored(const Eigen::Vector3d& vector) noexcept;
/// The same of one that turns (rate, torque).
[[nodiscard]] Eigen::Vector3d mirrored_turn(const Eigen::Vector3d& vector) noexcept;
[[nodiscard]] Eigen::Quaterniond mirrored(const Eigen::Quaterniond& orientation) noexcept;

/// The limits of a device as its hand has them: the power of its force is that of the handle's, so
/// force is divided by the scale, and stiffness and damping by its square.
[[nodiscard]] DeviceLimits mapped(DeviceLimits limits, const HandMapping& mapping) noexcept;

}  // namespace reckon::haptics
