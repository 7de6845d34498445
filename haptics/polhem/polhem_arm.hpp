// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Dimensions of a Polhem's arm, as its makers publish them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace reckon::haptics {

/// A base turns about the vertical axis (angle A). On it an upper link leans outwards (angle B, 0:
/// upright), and from its end a fore link reaches outwards (angle C, 0: hanging down). All three
/// motors are in the base and drive by cables, so B and C are each measured from the vertical, not
/// from each other. Three more encoders read the gimbal at the end.
///
/// Axes of the arm: x towards the operator, y to the operator's right, z up; the origin is on the
/// base's axis, at its foot.
struct PolhemArm {
  double base = 0.0;               ///< [m], height of the upper link's axis above the foot
  double upper = 0.0;              ///< [m], length of the upper link
  double fore = 0.0;               ///< [m], length of the fore link
  std::array<double, 3> ratios{};  ///< turns of a motor per turn of its joint
  double counts_per_turn = 0.0;    ///< of each motor's encoder, quadrature
  std::array<double, 3> torque_constants{};  ///< [N m/A], of the motors
  std::array<double, 3> encoder_signs{};     ///< sign of a count in the direction of its joint
  std::array<double, 3> motor_signs{};       ///< sign of a current in the direction of its joint
  double most_current = 0.0;                 ///< [A], greatest commanded current
  /// Counts in the start pose: straight ahead, the upper link upright, the fore link level.
  std::array<std::int16_t, 6> home_counts{};
  double gimbal_counts_per_turn = 0.0;
  std::array<double, 3> gimbal_signs{};  ///< of the counts, from the fore link outwards
  Eigen::Vector3d middle =
      Eigen::Vector3d::Zero();  ///< [m], middle of the workspace, in the arm's axes
};

/// The first Polhem. Values from the makers' open host library (haptikfabrikenapi, configuration
/// polhem_v1). The geometry of later models is not published.
[[nodiscard]] inline const PolhemArm& polhem_1() noexcept {
  // Capstans of 10 mm drive drums of 180, 100 and 100 mm.
  static const PolhemArm kArm{.base = 0.058,
                              .upper = 0.174,
                              .fore = 0.133,
                              .ratios = {18.0, 10.0, 10.0},
                              .counts_per_turn = 2000.0,
                              .torque_constants = {0.0538, 0.0538, 0.0538},
                              .encoder_signs = {-1.0, -1.0, -1.0},
                              .motor_signs = {-1.0, -1.0, -1.0},
                              .most_current = 2.999,
                              .home_counts = {0, 0, -5000, 0, 0, 0},
                              .gimbal_counts_per_turn = 1024.0,
                              .gimbal_signs = {-1.0, 1.0, -1.0},
                              .middle = {0.14, 0.0, 0.1}};
  return kArm;
}

}  // namespace reckon::haptics
