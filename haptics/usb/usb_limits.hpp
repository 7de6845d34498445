// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Known facts of a device type on USB, user overrides, and the resulting limits.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {

/// One exchange with a device on USB: the command waits for a frame (1 ms), and the report that
/// answers it for the next.
inline constexpr std::chrono::milliseconds kUsbExchange{2};

/// Known facts of a device type.
struct UsbFacts {
  const char* name = "";  ///< prefix of its notices
  std::uint16_t vendor = 0, product = 0;
  double most_force = 0.0;  ///< [N], > 0
  /// Share of the declared damping that the servo may use. The rest covers torques that stay
  /// constant while the motion of the handle turns the arms.
  double sure_share = 1.0;
  /// [N s/m], used unless the user states a measured value: a low guess if none is published.
  double assumed_damping = 0.0;
  double reach = 0.0;       ///< [m], half of the workspace along each axis of frame D
  double resolution = 0.0;  ///< [m], greatest step of the encoders at the handle
  /// [m/rad], > 0 if its joints are known: greatest motion of the handle per turn of its joints, at
  /// the middle of the workspace.
  double lever = 0.0;
  /// [m2], viscous friction of each joint per N s/m at the handle at the middle of the workspace,
  /// along the axis of frame D with the least damping. Only for a type with a lever.
  double joints_per_damping = 0.0;
};

/// Settings that the device does not report.
struct UsbSettings {
  /// Default of the chain, without a measurement: three exchanges.
  static constexpr std::chrono::nanoseconds kChain = 3 * kUsbExchange;

  double max_force = 1e9;      ///< [N], > 0; limited to the type's most_force
  double damping = 0.0;        ///< [N s/m], >= 0, a safe lower bound
  double spent_damping = 0.0;  ///< [N s/m], >= 0, part of its share that the driver uses itself
  /// [N m s/rad], >= 0, a safe lower bound of each joint's damping, which replaces `damping`; 0:
  /// uses `damping`. Only for a type with a lever.
  double joint_damping = 0.0;
  double spent_joint_damping = 0.0;  ///< [N m s/rad], >= 0, part of its share that the driver uses
  double max_stiffness = 0.0;        ///< [N/m]; 0: as damping, period and delay allow
  double max_speed = 2.0;            ///< [m/s]
  double resolution = 0.0;           ///< [m], >= 0, of the encoders at the handle; 0: the type's
  std::chrono::nanoseconds period{1'000'000};  ///< period of the servo
  /// Delay of the whole chain, > 0, rounded up to periods. If it is too short, readings fail, more
  /// often the shorter it is; the contact stays passive.
  std::chrono::nanoseconds chain = kChain;
};

/// The limits that a servo relies on. @throws std::invalid_argument: a setting is out of range
[[nodiscard]] DeviceLimits usb_limits(const UsbFacts& facts, const UsbSettings& settings);

}  // namespace reckon::haptics
