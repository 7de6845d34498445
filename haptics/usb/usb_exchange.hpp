// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exchange between the servo and the thread of a device on USB: the newest force one way, every
// reading the other.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"

namespace reckon::haptics {

/// A force as the servo wrote it.
struct UsbForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N], frame D
  std::int64_t number = 0;                          ///< number of the write, from 1
  std::chrono::nanoseconds at{0};                   ///< time of the write
  /// [m/rad], limit of the torques: their norm over all joints, for each newton, that the damping
  /// covers.
  double lever = std::numeric_limits<double>::infinity();
};

/// A report of the device, with the forces before and after its instant.
struct UsbReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  /// Tool -> D, a unit quaternion, if the device measures the orientation of its handle.
  std::optional<Eigen::Quaterniond> orientation = {};
  std::int64_t before = 0;  ///< number of the force held until then
  std::int64_t after = 0;   ///< number of the force held from then on
  /// From 1. Grows each time the force was dropped. Readings of two runs do not join: nothing is
  /// known of the motion between them.
  std::uint32_t run = 0;
  std::uint8_t buttons = 0;
  /// By the device's clock, if its reports have timestamps.
  std::optional<std::chrono::nanoseconds> at = {};
  std::chrono::nanoseconds heard{0};  ///< when the host received it, on the clock of the writes
  /// [m/rad], greatest motion of the handle per turn of its joints at this pose; 0: unknown.
  double lever = 0.0;
  double step =
      0.0;  ///< [m], resolution of the encoders at this pose, along each axis; 0: as in the limits
  double held = 1.0;  ///< share of the force `before` that was held
};

/// Neither side waits for the other. Allocates once, here.
struct UsbExchange {
  static constexpr std::size_t kReadings = 256;

  TripleBuffer<UsbForce> force;
  SpscRing<UsbReading> readings{kReadings};
  /// The last run that has ended: all its readings are outdated.
  std::atomic<std::uint32_t> ended_run{0};
};

}  // namespace reckon::haptics
