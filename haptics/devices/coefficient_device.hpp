// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Interface of a device that renders a force model by itself.
#pragma once

#include <Eigen/Core>
#include <chrono>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// The model that the device renders now.
struct ShownModel {
  SpringModel model;    ///< uploaded last
  double energy = 0.0;  ///< [J], energy in its account outside the walls
};

/// A device of kind `coefficients`. Its limits() have 1 or 2 axes, x and y, and a greatest
/// stiffness. The device keeps its own energy account, because only the device has the instant of
/// each change. It renders the model nearest to the requested one for which the energy in the
/// account suffices.
///
/// The rules of HapticDevice apply: only the servo's thread; all calls return at once, and none
/// throws or allocates. A requested model holds until the next one. Without a request for
/// kWatchdog, the walls are removed.
class CoefficientDevice : public HapticDevice {
 public:
  /// @param wanted walls in frame D
  virtual void state(const SpringModel& wanted, std::chrono::nanoseconds now) noexcept = 0;
  /// The model at the last read().
  [[nodiscard]] virtual ShownModel shown() const noexcept = 0;

  /// Does nothing: the device takes no force.
  void write(const Eigen::Vector3d& /*force*/, std::chrono::nanoseconds /*now*/) noexcept final {}
};

}  // namespace reckon::haptics
