// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the servo knows of a device that takes a force model and renders it by itself.
#pragma once

#include <Eigen/Core>
#include <chrono>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// What such a device shows now.
struct ShownModel {
  SpringModel model;    ///< that it was told last
  double energy = 0.0;  ///< [J], of its books, in no wall
};

/// A device of kind `coefficients`. Its limits() have 1 or 2 axes, those of its x and y, and a
/// greatest stiffness. The device itself keeps the energy books, where the instant of each change
/// is known: it shows the nearest model to the one stated that they pay for.
///
/// The same rules as of HapticDevice: one thread, the servo's; all calls return at once, none
/// throws or allocates. The model stated holds until the next one; where none came for kWatchdog
/// the walls are taken off.
class CoefficientDevice : public HapticDevice {
 public:
  /// @param wanted frame D
  virtual void state(const SpringModel& wanted, std::chrono::nanoseconds now) noexcept = 0;
  /// As of the last read().
  [[nodiscard]] virtual ShownModel shown() const noexcept = 0;

  /// It takes no force.
  void write(const Eigen::Vector3d& /*force*/, std::chrono::nanoseconds /*now*/) noexcept final {}
};

}  // namespace reckon::haptics
