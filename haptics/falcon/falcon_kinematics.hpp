// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Kinematics of a Novint Falcon: position of its handle and torques of its motors. Pure functions
// of three angles: no state, no allocation, any thread.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <numbers>
#include <optional>

namespace reckon::haptics {

/// A Falcon has three legs about its axis z, 120 degrees apart. In each, an arm turns about an axis
/// across the leg, with a motor and an encoder. From the arm's end a parallelogram leads to the
/// handle, which never rotates. Axes: z towards the operator, y up, x to the right; the origin is
/// in the plane of the arms' axes.
///
/// Dimensions [m], measured by authors of open drivers.
struct FalconGeometry {
  static constexpr double kArm = 0.060;      ///< from the arm's axis to the parallelogram
  static constexpr double kRod = 0.1025;     ///< length of the parallelogram
  static constexpr double kJoints = 0.0225;  ///< joints of both its ends together, along the leg
  static constexpr double kAxis = 0.0400;    ///< distance of the arm's axis from the device's axis
  static constexpr double kHandle =
      0.01443;  ///< distance of the parallelogram from the middle of the handle
  static constexpr double kAside = 0.00191;  ///< sideways offset of the parallelogram
  /// Directions of the legs [rad], from x towards y.
  static constexpr std::array<double, 3> kLegs{105.0 * std::numbers::pi / 180.0,
                                               -15.0 * std::numbers::pi / 180.0,
                                               -135.0 * std::numbers::pi / 180.0};
  /// Middle of the workspace along z [m]: origin of frame D of the device.
  static constexpr double kMiddle = 0.115;
  /// Half of the workspace [m], along each axis.
  static constexpr double kReach = 0.040;
  /// Greatest step of the encoders at the handle in the workspace [m]; 41 um in its middle.
  static constexpr double kResolution = 90e-6;
  /// Greatest motion of the handle per turn of the arms [m/rad], in the middle of the workspace.
  static constexpr double kLever = 0.0698126;
};

/// Angle of an arm [rad] at an encoder's count: 320 slots, quadrature, on a drum of 14.25 mm that
/// rolls on a sector of 110 mm; 35 degrees at count 0, where homing leaves it.
[[nodiscard]] double falcon_angle(std::int16_t count) noexcept;
/// One count [rad].
[[nodiscard]] double falcon_count_step() noexcept;
/// The count nearest to an angle [rad], clamped to int16_t.
[[nodiscard]] std::int16_t falcon_count(double angle) noexcept;

/// Converts a vector from the Falcon's axes to frame D of the device: x to the right, y away from
/// the operator, z up.
[[nodiscard]] inline Eigen::Vector3d device_axes(const Eigen::Vector3d& v_falcon) noexcept {
  return {v_falcon.x(), -v_falcon.z(), v_falcon.y()};
}
/// The inverse.
[[nodiscard]] inline Eigen::Vector3d falcon_axes(const Eigen::Vector3d& v_D) noexcept {
  return {v_D.x(), v_D.z(), -v_D.y()};
}
/// Converts a position [m] from FalconGeometry's axes to frame D, whose origin is the middle of the
/// workspace.
[[nodiscard]] inline Eigen::Vector3d device_place(const Eigen::Vector3d& p_falcon) noexcept {
  return device_axes(p_falcon - Eigen::Vector3d(0, 0, FalconGeometry::kMiddle));
}

/// Position and Jacobian of the handle.
struct FalconPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], in the axes of FalconGeometry
  /// dx / dtheta [m/rad], a column for each arm.
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
};

/// Forward kinematics. The handle is at the intersection of three tori, which has no closed form.
/// The spheres that touch the tori have one; Newton's method from their intersection converges
/// within 1e-9 m. About 0.2 us. @param angles [rad] @return std::nullopt if the angles cannot be
/// assembled, near a singular pose, or for values that are not finite
[[nodiscard]] std::optional<FalconPose> falcon_pose(const Eigen::Vector3d& angles) noexcept;

/// Inverse kinematics, closed form: angles [rad] at a position [m]. @return std::nullopt out of
/// reach, or for values that are not finite
[[nodiscard]] std::optional<Eigen::Vector3d> falcon_angles(
    const Eigen::Vector3d& position) noexcept;

/// Torques [N m] that hold `force` [N] at the handle: J^T F. Both have the same power for each
/// motion.
[[nodiscard]] inline Eigen::Vector3d falcon_torques(const Eigen::Matrix3d& jacobian,
                                                    const Eigen::Vector3d& force) noexcept {
  return jacobian.transpose() * force;
}

}  // namespace reckon::haptics
