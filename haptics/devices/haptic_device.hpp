// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the servo knows of a haptic device. Frame D: the device's own axes, metres.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <optional>

namespace reckon::haptics {

/// Which way causality runs at the handle.
enum class DeviceKind : std::uint8_t {
  impedance,     ///< gives its pose, takes a force
  admittance,    ///< gives the operator's force, takes a motion
  coefficients,  ///< takes a force model and renders it by itself
};

/// What a device can do and what one may rely on. All of it is fixed after construction.
struct DeviceLimits {
  DeviceKind kind = DeviceKind::impedance;
  /// 3: gives a position and shows a force. 6: gives a pose, shows a torque. 1, 2: coefficients.
  int axes = 3;
  double max_force = 0.0;      ///< [N], > 0: beyond it the output is scaled, direction kept
  double max_stiffness = 0.0;  ///< [N/m], 0 = no limit of its own (the sampled bound always holds)
  double damping = 0.0;        ///< [N s/m], >= 0: the viscous friction one is *sure* of
  /// [m/rad], the greatest way of the handle for a turn of its joints where `damping` is sure. It
  /// is the joints' friction then, and less where the way is longer: see DeviceSample::damping. 0:
  /// it is sure at every pose.
  double lever = 0.0;
  double max_speed = 1.0;  ///< [m/s], faster than this is a fault
  Eigen::Vector3d workspace_min = Eigen::Vector3d::Constant(-0.05);  ///< [m], frame D
  Eigen::Vector3d workspace_max = Eigen::Vector3d::Constant(0.05);   ///< [m], frame D
  double max_torque = 0.0;                                           ///< [N m], of 6 axes, > 0
  double turn_damping = 0.0;     ///< [N m s/rad], of 6 axes, > 0: sure for a turn about any axis
  double turn_resolution = 0.0;  ///< [rad], step of its angle sensors; 0 = exact
  int delay_samples = 0;         ///< writes after which a force is at the handle
  double resolution = 0.0;       ///< [m], step of its position sensors, along each axis; 0 = exact
};

/// How a device of six axes is turned.
struct DeviceTurn {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< tool -> D, a unit one
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  ///< [rad/s], frame D; only with has_velocity
};

/// One reading of a device.
struct DeviceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s], frame D; only with has_velocity
  bool has_velocity = false;
  /// How long the handle took for its way since the reading before, by the device's own clock (0:
  /// this is that very reading) or by when its forces were written. Absent: as the servo waited.
  std::optional<std::chrono::nanoseconds> took = {};
  std::optional<DeviceTurn> turn = {};  ///< of 6 axes; a reading of these without it failed
  /// Of 3 axes [N s/m], >= 0: sure at this pose, and for each force written until the next reading
  /// wherever the handle is when it is held; more than that of the limits is no more. Absent: that
  /// of the limits.
  std::optional<double> damping = {};
  /// Of 3 axes [m], >= 0: step of its position sensors at this pose, along each axis. Absent: that
  /// of the limits.
  std::optional<double> resolution = {};
  /// [0, 1], least share of the written force that it held since the reading before: its motors
  /// could hold no more, or more would not have been paid for.
  double held = 1.0;
  bool enabled = true;    ///< the operator's (dead man's) switch: force only while it is held
  bool ok = false;        ///< false: no reading this time (unplugged, transfer failed)
  bool watchdog = false;  ///< the device went to zero force by itself since the last read
  /// With watchdog: where the handle was at that moment [m], frame D, if the device knows. The
  /// books then stay exact and the force goes on; otherwise everything the contacts hold is written
  /// off.
  std::optional<Eigen::Vector3d> released_at = {};
  std::optional<Eigen::Quaterniond> released_turned = {};  ///< tool -> D, of 6 axes, at that moment
  std::uint32_t buttons = 0;
};

/// An impedance device as the servo sees it. One thread (the servo's) calls read and write; both
/// return at once, neither throws nor allocates. Every implementation holds the last force written
/// until the next write and drops it to zero when no write came for kWatchdog, or sooner: a force
/// that is held for t too long costs up to |F| v t at the port, which no servo can take back.
class HapticDevice {
 public:
  static constexpr std::chrono::milliseconds kWatchdog{10};

  virtual ~HapticDevice() = default;

  [[nodiscard]] virtual DeviceLimits limits() const noexcept = 0;

  /// @param now steady time of this servo step, never decreasing.
  [[nodiscard]] virtual DeviceSample read(std::chrono::nanoseconds now) noexcept = 0;

  /// @param force [N], frame D, on the operator's hand; held until the next write.
  virtual void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept = 0;
  /// The same for a device of 6 axes. @param torque about the handle [N m], frame D
  virtual void write_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& /*torque*/,
                            std::chrono::nanoseconds now) noexcept {
    write(force, now);
  }

 protected:
  HapticDevice() = default;
  HapticDevice(const HapticDevice&) = default;
  HapticDevice& operator=(const HapticDevice&) = default;
};

}  // namespace reckon::haptics
