// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device that measures the force of the hand and moves by itself: an admittance display. Frame D.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// What closes the loop inside the device.
enum class MotionLoop : std::uint8_t {
  position,  ///< goes where it is told, by a spring and a damper of its motors
  velocity,  ///< goes as fast as it is told, and as much faster as it is behind
};

/// What such a device can do. All of it is fixed after construction.
struct MotionLimits {
  double max_force = 10.0;  ///< [N] > 0, that its sensor measures
  double max_speed = 1.0;   ///< [m/s] > 0, that it can go
  Eigen::Vector3d workspace_min = Eigen::Vector3d::Constant(-0.05);  ///< [m]
  Eigen::Vector3d workspace_max = Eigen::Vector3d::Constant(0.05);   ///< [m]
};

/// One reading.
struct MotionSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], measured, of the handle
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< [N], of the hand on the handle
  bool enabled = true;                                 ///< the operator's switch
  bool ok = false;                                     ///< false: no reading this time
  std::uint32_t buttons = 0;
};

/// An admittance device as a servo sees it. One thread calls read and command; both return at once,
/// neither throws nor allocates. Every implementation stands still when no command came for
/// HapticDevice::kWatchdog.
class MotionDevice {
 public:
  virtual ~MotionDevice() = default;

  [[nodiscard]] virtual MotionLimits limits() const noexcept = 0;
  /// @param now steady time of this servo step, never decreasing.
  [[nodiscard]] virtual MotionSample read(std::chrono::nanoseconds now) noexcept = 0;
  /// Where the handle is to be now, and how fast it is to go there: for a loop of positions the
  /// second is what it adds, for one of velocities the first is what it is corrected by.
  /// @param position [m]  @param velocity [m/s]
  virtual void command(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                       std::chrono::nanoseconds now) noexcept = 0;

 protected:
  MotionDevice() = default;
  MotionDevice(const MotionDevice&) = default;
  MotionDevice& operator=(const MotionDevice&) = default;
};

}  // namespace reckon::haptics
