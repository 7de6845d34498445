// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Kinematics of a Polhem: position and orientation of its handle, and the torques of its motors.
// Pure functions: no state, no allocation, any thread. Angles are A, B, C of PolhemArm [rad].
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>

#include "reckon/haptics/polhem/polhem_arm.hpp"

namespace reckon::haptics {

/// Joint angles from encoder counts, which may exceed 16 bits.
[[nodiscard]] Eigen::Vector3d polhem_angles_at(const PolhemArm& arm,
                                               const std::array<std::int32_t, 3>& counts) noexcept;
/// The counts nearest to these angles.
[[nodiscard]] std::array<std::int32_t, 3> polhem_counts_at(const PolhemArm& arm,
                                                           const Eigen::Vector3d& angles) noexcept;
/// One count of each encoder [rad].
[[nodiscard]] Eigen::Vector3d polhem_count_steps(const PolhemArm& arm) noexcept;

/// Converts a vector from the arm's axes to frame D of the device: x to the right, y away from the
/// operator, z up.
[[nodiscard]] inline Eigen::Vector3d polhem_to_device(const Eigen::Vector3d& v_arm) noexcept {
  return {v_arm.y(), -v_arm.x(), v_arm.z()};
}
/// The inverse.
[[nodiscard]] inline Eigen::Vector3d device_to_polhem(const Eigen::Vector3d& v_D) noexcept {
  return {-v_D.y(), v_D.x(), v_D.z()};
}

/// Position and Jacobian of the handle.
struct PolhemPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], in the arm's axes
  /// dx / dtheta [m/rad], a column for each joint.
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
};

/// Forward kinematics. @return std::nullopt near a singular pose (the handle within 30 mm of the
/// base's axis, or the links within 15 degrees of being in line), for another assembly mode, or for
/// values that are not finite
[[nodiscard]] std::optional<PolhemPose> polhem_pose(const PolhemArm& arm,
                                                    const Eigen::Vector3d& angles) noexcept;

/// Inverse kinematics, closed form: angles at a position [m] in the arm's axes. @return
/// std::nullopt out of reach, or for values that are not finite
[[nodiscard]] std::optional<Eigen::Vector3d> polhem_angles(
    const PolhemArm& arm, const Eigen::Vector3d& position) noexcept;

/// Orientation of the tool, tool -> D. It is the identity if the fore link is level and straight
/// ahead and the gimbal is at zero. @param gimbal counts, from the fore link outwards
[[nodiscard]] Eigen::Quaterniond polhem_orientation(
    const PolhemArm& arm, const Eigen::Vector3d& angles,
    const std::array<std::int16_t, 3>& gimbal) noexcept;

/// Joint torques [N m] that hold `force` [N], in the arm's axes, at the handle: J^T F. Both have
/// the same power for each motion.
[[nodiscard]] inline Eigen::Vector3d polhem_torques(const Eigen::Matrix3d& jacobian,
                                                    const Eigen::Vector3d& force) noexcept {
  return jacobian.transpose() * force;
}
/// Weights of the links, as the torques [N m] that pull each down while it is level; the upper
/// link's includes its load. 0: not compensated.
struct PolhemWeights {
  double upper = 0.0;
  double fore = 0.0;
};
/// Joint torques [N m] that hold the links up: the gradient of their potential energy, so they add
/// no energy on any closed path.
[[nodiscard]] Eigen::Vector3d polhem_hold_up(const PolhemWeights& weights,
                                             const Eigen::Vector3d& angles) noexcept;
/// Motor currents [A] that give these joint torques [N m].
[[nodiscard]] Eigen::Vector3d polhem_currents(const PolhemArm& arm,
                                              const Eigen::Vector3d& torques) noexcept;
/// The inverse.
[[nodiscard]] Eigen::Vector3d polhem_torques_of(const PolhemArm& arm,
                                                const Eigen::Vector3d& currents) noexcept;

}  // namespace reckon::haptics
