// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is known of a kind of device on USB, what its user states of his own, and what a servo may
// rely on by both.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// One exchange with a device on USB: a command waits for the next frame (1 ms), and the report
/// that answers it for another.
inline constexpr std::chrono::milliseconds kUsbExchange{2};

/// Of a kind of device.
struct UsbFacts {
  const char* name = "";  ///< as its notices begin
  std::uint16_t vendor = 0, product = 0;
  double most_force = 0.0;  ///< [N], > 0
  /// Share of the stated damping that is left for the servo. The rest answers for torques that stay
  /// as they are while the handle turns the arms.
  double sure_share = 1.0;
  /// [N s/m], taken as sure where nobody has measured it: a low guess where none is published.
  double assumed_damping = 0.0;
  double reach = 0.0;       ///< [m], half of the work space, along each axis of frame D
  double resolution = 0.0;  ///< [m], step of the encoders at the handle, the greatest there
  /// [m/rad], > 0 where its joints are known: the greatest way of the handle for a turn of them, in
  /// the middle of the work space.
  double lever = 0.0;
  /// [m2], friction of each joint for each N s/m of the handle in the middle of the work space,
  /// along the axis of frame D that has least; of a kind with a lever.
  double joints_per_damping = 0.0;
};

/// What is not in the device's own data.
struct UsbSettings {
  /// Of the chain where nobody has measured it: three exchanges.
  static constexpr std::chrono::nanoseconds kChain = 3 * kUsbExchange;

  double max_force = 1e9;      ///< [N], > 0; more than the kind's most is no more
  double damping = 0.0;        ///< [N s/m], >= 0, that one is sure of
  double spent_damping = 0.0;  ///< [N s/m], >= 0, of its share, that the driver needs for itself
  /// [N m s/rad], >= 0, of each joint, that one is sure of, in the place of `damping`; 0: it is
  /// that of the handle which is sure. Only of a kind with a lever.
  double joint_damping = 0.0;
  double spent_joint_damping = 0.0;  ///< [N m s/rad], >= 0, of its share, likewise
  double max_stiffness = 0.0;        ///< [N/m], 0 = as much as damping, period and delay allow
  double max_speed = 2.0;            ///< [m/s]
  double resolution = 0.0;  ///< [m], >= 0, of its encoders at the handle; 0 = as its kind has
  std::chrono::nanoseconds period{1'000'000};  ///< of the servo
  /// Of the whole chain, > 0, rounded up to periods. Where it is too short readings fail, more
  /// often the shorter it is, and no energy is made.
  std::chrono::nanoseconds chain = kChain;
};

/// What a servo relies on. @throws std::invalid_argument for settings out of their range
[[nodiscard]] DeviceLimits usb_limits(const UsbFacts& facts, const UsbSettings& settings);

}  // namespace reckon::haptics
