// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Interface of a haptic device to the servo. Frame D: the device's own axes, metres.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <optional>

namespace reckon::haptics {

/// Causality at the handle.
enum class DeviceKind : std::uint8_t {
  impedance,     ///< measures its pose, renders a force
  admittance,    ///< measures the operator's force, renders a motion
  coefficients,  ///< renders a force model by itself
};

/// Guaranteed limits of a device. All are fixed after construction.
struct DeviceLimits {
  DeviceKind kind = DeviceKind::impedance;
  /// 3: position and force. 6: pose and wrench. 1, 2: coefficients.
  int axes = 3;
  double max_force = 0.0;      ///< [N], > 0: beyond it the output is scaled, direction kept
  double max_stiffness = 0.0;  ///< [N/m]; 0: no limit of its own (the sampled bound always holds)
  double damping = 0.0;        ///< [N s/m], >= 0: guaranteed viscous friction
  /// [m/rad], greatest motion of the handle per turn of its joints at the pose for which `damping`
  /// is guaranteed. The joints then cause the friction, and the damping is less at poses with a
  /// longer lever: see DeviceSample::damping. 0: `damping` is guaranteed at every pose.
  double lever = 0.0;
  double max_speed = 1.0;  ///< [m/s]; higher speeds are a fault
  Eigen::Vector3d workspace_min = Eigen::Vector3d::Constant(-0.05);  ///< [m], frame D
  Eigen::Vector3d workspace_max = Eigen::Vector3d::Constant(0.05);   ///< [m], frame D
  double max_torque = 0.0;                                           ///< [N m], > 0, for 6 axes
  double turn_damping =
      0.0;  ///< [N m s/rad], > 0, for 6 axes: guaranteed for rotation about any axis
  double turn_resolution = 0.0;  ///< [rad], step of its angle sensors; 0: exact
  int delay_samples = 0;         ///< number of writes until a force is at the handle
  double resolution = 0.0;       ///< [m], step of its position sensors, along each axis; 0: exact
};

/// Orientation of a device of six axes.
struct DeviceTurn {
  Eigen::Quaterniond orientation =
      Eigen::Quaterniond::Identity();              ///< tool -> D, a unit quaternion
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  ///< [rad/s], frame D; only with has_velocity
};

/// One reading of a device.
struct DeviceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s], frame D; only with has_velocity
  bool has_velocity = false;
  /// Duration of the motion since the last reading, by the device's clock (0: the same reading) or
  /// by the times of its writes. std::nullopt: the interval of the servo's reads.
  std::optional<std::chrono::nanoseconds> took = {};
  std::optional<DeviceTurn> turn = {};  ///< for 6 axes, where a reading without it has failed
  /// For 3 axes [N s/m], >= 0: damping guaranteed at this pose, and for each force written until
  /// the next reading, wherever the handle is while it is held; at most the limit's. std::nullopt:
  /// as in the limits.
  std::optional<double> damping = {};
  /// For 3 axes [m], >= 0: step of its position sensors at this pose, along each axis.
  /// std::nullopt: as in the limits.
  std::optional<double> resolution = {};
  /// [0, 1], least share of the written force that it held since the last reading: limited by its
  /// motors, or by the energy available.
  double held = 1.0;
  bool enabled = true;    ///< the operator's (dead man's) switch: force only while it is held
  bool ok = false;        ///< false: no reading this time (unplugged, transfer failed)
  bool watchdog = false;  ///< the device went to zero force by itself since the last read
  /// With watchdog: position of the handle at that moment [m], frame D, if known. Then the energy
  /// account stays exact and the force resumes; otherwise all energy that the contacts hold is
  /// written off.
  std::optional<Eigen::Vector3d> released_at = {};
  std::optional<Eigen::Quaterniond> released_turned =
      {};  ///< tool -> D, for 6 axes, at that moment
  std::uint32_t buttons = 0;
};

/// An impedance device. Only the servo's thread calls read and write; both return at once, and
/// neither throws nor allocates. Every implementation holds the last force until the next write,
/// and sets zero force if no write follows within kWatchdog, or sooner. A force held for t too long
/// costs up to |F| v t at the port, which no servo can recover.
class HapticDevice {
 public:
  static constexpr std::chrono::milliseconds kWatchdog{10};

  virtual ~HapticDevice() = default;

  [[nodiscard]] virtual DeviceLimits limits() const noexcept = 0;

  /// @param now steady time of this servo step, never decreasing.
  [[nodiscard]] virtual DeviceSample read(std::chrono::nanoseconds now) noexcept = 0;

  /// @param force [N], frame D, on the operator's hand; held until the next write.
  virtual void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept = 0;
  /// The same for a device of 6 axes. @param torque [N m], frame D, on the handle
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
