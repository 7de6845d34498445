// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The measures of a Polhem's arm, as its makers publish them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace reckon::haptics {

/// A base turns about the upright axis (angle A). On it an upper link leans outwards (angle B, 0:
/// upright), and from its end a fore link reaches outwards (angle C, 0: hanging down). All three
/// motors drive by cables from the base, so that B and C are each told against the upright axis,
/// and not against one another. Three more encoders read how a gimbal at the end is turned.
///
/// Axes of the arm: x towards the operator, y to the operator's right, z up; the origin is on the
/// base's axis, at its foot.
struct PolhemArm {
  double base = 0.0;                         ///< [m], from the foot to the upper link's axis
  double upper = 0.0;                        ///< [m], of the upper link
  double fore = 0.0;                         ///< [m], of the fore link
  std::array<double, 3> ratios{};            ///< turns of a motor for one of its joint
  double counts_per_turn = 0.0;              ///< of each motor's encoder, read four times
  std::array<double, 3> torque_constants{};  ///< [N m/A], of the motors
  std::array<double, 3> encoder_signs{};     ///< of a count, in a joint's own direction
  std::array<double, 3> motor_signs{};       ///< of a current, in a joint's own direction
  double most_current = 0.0;                 ///< [A], that a motor is told
  /// Counts in the start pose: straight ahead, the upper link upright, the fore link level.
  std::array<std::int16_t, 6> home_counts{};
  double gimbal_counts_per_turn = 0.0;
  std::array<double, 3> gimbal_signs{};              ///< from the fore link outwards
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< [m], of the work space
};

/// The first Polhem: numbers of the makers' open host library (haptikfabrikenapi, configuration
/// polhem_v1). The geometry of later ones is not published.
[[nodiscard]] const PolhemArm& polhem_1() noexcept;

}  // namespace reckon::haptics
