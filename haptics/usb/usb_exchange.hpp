// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Between the servo and the thread of a device on USB: the newest force one way, every reading the
// other.
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
  std::int64_t number = 0;                          ///< of the write, from 1
  std::chrono::nanoseconds at{0};                   ///< of the write
  /// [m/rad]: the torques of all joints together that are paid for are so much for each newton.
  double lever = std::numeric_limits<double>::infinity();
};

/// A report of the device, with the forces on both sides of its instant.
struct UsbReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  /// Tool -> D, a unit one, where the device can tell how its handle is turned.
  std::optional<Eigen::Quaterniond> orientation = {};
  std::int64_t before = 0;  ///< number of the force that was held until then
  std::int64_t after = 0;   ///< number of the force that is held from then on
  /// From 1 on. Grows where the force was dropped, whatever for: readings of two runs do not join.
  std::uint32_t run = 0;
  std::uint8_t buttons = 0;
  /// By the device's own clock, where its reports have one.
  std::optional<std::chrono::nanoseconds> at = {};
  std::chrono::nanoseconds heard{0};  ///< when the host had it, on the clock of the writes
  /// [m/rad], the greatest way of the handle for a turn of its joints at this pose; 0: not known.
  double lever = 0.0;
  double step = 0.0;  ///< [m], of its encoders at this pose, along each axis; 0: as anywhere
  double held = 1.0;  ///< share of the force `before` that was held
};

/// Neither side waits for the other. Allocates once, here.
struct UsbExchange {
  static constexpr std::size_t kReadings = 256;

  TripleBuffer<UsbForce> force;
  SpscRing<UsbReading> readings{kReadings};
  /// The last run that is over: none of its readings, shown or not, tells a place of now.
  std::atomic<std::uint32_t> ended_run{0};
};

}  // namespace reckon::haptics
