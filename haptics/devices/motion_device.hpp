// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Interface of an admittance device: it measures the force of the hand and moves by itself. Frame
// D.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// Control loop inside the device.
enum class MotionLoop : std::uint8_t {
  position,  ///< follows a commanded position with a spring and a damper
  velocity,  ///< follows a commanded velocity, plus a correction of its position error
};

/// Limits of an admittance device. All are fixed after construction.
struct MotionLimits {
  double max_force = 10.0;  ///< [N] > 0, greatest measurable force
  double max_speed = 1.0;   ///< [m/s] > 0, greatest speed
  Eigen::Vector3d workspace_min = Eigen::Vector3d::Constant(-0.05);  ///< [m]
  Eigen::Vector3d workspace_max = Eigen::Vector3d::Constant(0.05);   ///< [m]
};

/// One reading.
struct MotionSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], measured position of the handle
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< [N], force of the hand on the handle
  bool enabled = true;                                 ///< the operator's switch
  bool ok = false;                                     ///< false: no reading this time
  std::uint32_t buttons = 0;
};

/// An admittance device. One thread calls read and command; both return at once, and neither throws
/// nor allocates. Every implementation stops if no command follows within HapticDevice::kWatchdog.
class MotionDevice {
 public:
  virtual ~MotionDevice() = default;

  [[nodiscard]] virtual MotionLimits limits() const noexcept = 0;
  /// @param now steady time of this servo step, never decreasing.
  [[nodiscard]] virtual MotionSample read(std::chrono::nanoseconds now) noexcept = 0;
  /// Sets the commanded position and velocity. For a position loop the velocity is a feed-forward;
  /// for a velocity loop the position serves as correction.
  /// @param position [m]  @param velocity [m/s]
  virtual void command(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                       std::chrono::nanoseconds now) noexcept = 0;

 protected:
  MotionDevice() = default;
  MotionDevice(const MotionDevice&) = default;
  MotionDevice& operator=(const MotionDevice&) = default;
};

}  // namespace reckon::haptics
