// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the handle of a Polhem is, how it is turned, and what its motors do there. Pure functions:
// no state, no allocation, any thread. Angles are those of PolhemArm: A, B, C [rad].
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>

#include "reckon/haptics/polhem/polhem_arm.hpp"

namespace reckon::haptics {

/// Angles of the joints at counts of their encoders, which may be beyond those of 16 bits.
[[nodiscard]] Eigen::Vector3d polhem_angles_at(const PolhemArm& arm,
                                               const std::array<std::int32_t, 3>& counts) noexcept;
/// Counts that are nearest to angles.
[[nodiscard]] std::array<std::int32_t, 3> polhem_counts_at(const PolhemArm& arm,
                                                           const Eigen::Vector3d& angles) noexcept;
/// One count of each encoder [rad].
[[nodiscard]] Eigen::Vector3d polhem_count_steps(const PolhemArm& arm) noexcept;

/// A direction in the arm's axes as in those of frame D, which are a device's: x to the right, y
/// away from the operator, z up.
[[nodiscard]] inline Eigen::Vector3d polhem_to_device(const Eigen::Vector3d& v_arm) noexcept {
  return {v_arm.y(), -v_arm.x(), v_arm.z()};
}
/// And back.
[[nodiscard]] inline Eigen::Vector3d device_to_polhem(const Eigen::Vector3d& v_D) noexcept {
  return {-v_D.y(), v_D.x(), v_D.z()};
}

/// The handle at three angles.
struct PolhemPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], in the arm's axes
  /// dx / dtheta [m/rad], a column for each joint.
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
};

/// Where the handle is. @return nothing near a singular pose (the handle within 30 mm of the base's
/// axis, or the links within 15 degrees of being in line), where the arm is assembled another way,
/// or for values that are not finite
[[nodiscard]] std::optional<PolhemPose> polhem_pose(const PolhemArm& arm,
                                                    const Eigen::Vector3d& angles) noexcept;

/// The angles at a position [m] in the arm's axes, closed form. @return nothing out of reach, or
/// for values that are not finite
[[nodiscard]] std::optional<Eigen::Vector3d> polhem_angles(
    const PolhemArm& arm, const Eigen::Vector3d& position) noexcept;

/// How the tool is turned, tool -> D, where its axes are those of D while the fore link is level,
/// straight ahead and the gimbal at its zero. @param gimbal counts, from the fore link outwards
[[nodiscard]] Eigen::Quaterniond polhem_orientation(
    const PolhemArm& arm, const Eigen::Vector3d& angles,
    const std::array<std::int16_t, 3>& gimbal) noexcept;

/// Torques about the joints [N m] that hold `force` [N], in the arm's axes, at the handle: J^T F,
/// of the same power for each motion.
[[nodiscard]] inline Eigen::Vector3d polhem_torques(const Eigen::Matrix3d& jacobian,
                                                    const Eigen::Vector3d& force) noexcept {
  return jacobian.transpose() * force;
}
/// What the links weigh: the torques [N m] that pull each of them down while it is level, the upper
/// one with what it carries. 0: it is not made up for.
struct PolhemWeights {
  double upper = 0.0;
  double fore = 0.0;
};
/// Torques about the joints [N m] that hold the links up: the slope of the height of their weights,
/// so that they make no energy on any closed way.
[[nodiscard]] Eigen::Vector3d polhem_hold_up(const PolhemWeights& weights,
                                             const Eigen::Vector3d& angles) noexcept;
/// Currents of the motors [A] that make torques about the joints [N m].
[[nodiscard]] Eigen::Vector3d polhem_currents(const PolhemArm& arm,
                                              const Eigen::Vector3d& torques) noexcept;
/// And back.
[[nodiscard]] Eigen::Vector3d polhem_torques_of(const PolhemArm& arm,
                                                const Eigen::Vector3d& currents) noexcept;

}  // namespace reckon::haptics
