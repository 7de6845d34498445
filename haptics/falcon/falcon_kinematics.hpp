// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the handle of a Novint Falcon is, and what its motors do there. Pure functions of three
// angles: no state, no allocation, any thread.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <numbers>
#include <optional>

namespace reckon::haptics {

/// A Falcon has three legs about its axis z, 120 degrees apart. In each an arm turns about an
/// axis across the leg; a motor drives it and an encoder reads it. From the arm's end a
/// parallelogram leads to the handle, which never turns. Axes: z towards the operator, y up,
/// x to the right; the origin is where the axes of the arms lie.
///
/// Measures that the makers of open drivers took of the device [m].
struct FalconGeometry {
  static constexpr double kArm = 0.060;       ///< from the arm's axis to the parallelogram
  static constexpr double kRod = 0.1025;      ///< length of the parallelogram
  static constexpr double kJoints = 0.0225;   ///< both its ends' joints together, along the leg
  static constexpr double kAxis = 0.0400;     ///< of the arm's axis from the device's axis
  static constexpr double kHandle = 0.01443;  ///< of the parallelogram from the handle's middle
  static constexpr double kAside = 0.00191;   ///< by which the parallelogram stands askew
  /// Directions of the legs [rad], from x towards y.
  static constexpr std::array<double, 3> kLegs{105.0 * std::numbers::pi / 180.0,
                                               -15.0 * std::numbers::pi / 180.0,
                                               -135.0 * std::numbers::pi / 180.0};
  /// The middle of the work space [m]: origin of frame D of the device.
  static constexpr double kMiddle = 0.115;
  /// Half of the work space [m], along each axis.
  static constexpr double kReach = 0.040;
  /// Step of the encoders at the handle [m], the greatest in the work space; 41 um in its middle.
  static constexpr double kResolution = 90e-6;
  /// Greatest way of the handle for a turn of the arms [m/rad], in the middle of the work space.
  static constexpr double kLever = 0.0698126;
};

/// Angle of an arm [rad] at an encoder's count: 320 slots, read four times, on a drum of 14.25 mm
/// that rolls on a sector of 110 mm; 35 degrees at count 0, where homing leaves it.
[[nodiscard]] double falcon_angle(std::int16_t count) noexcept;
/// One count [rad].
[[nodiscard]] double falcon_count_step() noexcept;
/// Count that is nearest to an angle [rad]; the ends of int16_t where it is beyond them.
[[nodiscard]] std::int16_t falcon_count(double angle) noexcept;

/// A direction in the Falcon's axes as in those of frame D, which are a device's: x to the right, y
/// away from the operator, z up.
[[nodiscard]] inline Eigen::Vector3d device_axes(const Eigen::Vector3d& v_falcon) noexcept {
  return {v_falcon.x(), -v_falcon.z(), v_falcon.y()};
}
/// And back.
[[nodiscard]] inline Eigen::Vector3d falcon_axes(const Eigen::Vector3d& v_D) noexcept {
  return {v_D.x(), v_D.z(), -v_D.y()};
}
/// A place of FalconGeometry's axes in frame D [m], whose origin is the middle of the work space.
[[nodiscard]] inline Eigen::Vector3d device_place(const Eigen::Vector3d& p_falcon) noexcept {
  return device_axes(p_falcon - Eigen::Vector3d(0, 0, FalconGeometry::kMiddle));
}

/// The handle at three angles.
struct FalconPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], in the axes of FalconGeometry
  /// dx / dtheta [m/rad], a column for each arm.
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
};

/// Forward: where the handle is. Three tori meet there, which no formula of roots solves; the
/// spheres that touch them do, and Newton's steps from their point end within 1e-9 m. About
/// 0.2 us. @param angles [rad] @return nothing where no way of assembling it reaches these angles,
/// near a singular pose, or for values that are not finite
[[nodiscard]] std::optional<FalconPose> falcon_pose(const Eigen::Vector3d& angles) noexcept;

/// Inverse, closed form: the angles [rad] at a position [m]. @return nothing out of reach, or for
/// values that are not finite
[[nodiscard]] std::optional<Eigen::Vector3d> falcon_angles(
    const Eigen::Vector3d& position) noexcept;

/// Torques [N m] that hold `force` [N] at the handle: J^T F, of the same power for each motion.
[[nodiscard]] inline Eigen::Vector3d falcon_torques(const Eigen::Matrix3d& jacobian,
                                                    const Eigen::Vector3d& force) noexcept {
  return jacobian.transpose() * force;
}

}  // namespace reckon::haptics
