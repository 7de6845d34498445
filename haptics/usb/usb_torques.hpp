// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts forces at the handle to joint torques and limits them. Pure functions, any thread.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// Singular values of the Jacobian, ascending: motion of the handle per turn of its joints [m/rad].
/// About 60 ns. @param jacobian dx / dtheta
///
/// Joints with a viscous friction b [N m s/rad] each give the handle a damping of b / lever^2,
/// least in the direction of the longest lever.
[[nodiscard]] inline Eigen::Vector3d levers_of(const Eigen::Matrix3d& jacobian) noexcept {
  const Eigen::Matrix3d squares = jacobian.transpose() * jacobian;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> turns;
  turns.computeDirect(squares, Eigen::EigenvaluesOnly);
  return turns.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

/// Share of a force that its lever covers, [0, 1]. @param torques [N m] of the whole force
[[nodiscard]] inline double paid_share(const UsbForce& force,
                                       const Eigen::Vector3d& torques) noexcept {
  const double asked = torques.norm(), paid = force.lever * force.force.norm();
  return asked > paid ? paid / asked : 1.0;
}

/// Largest share of `wanted` with no element beyond its `most`, [0, 1]. @param most >= 0
[[nodiscard]] inline double share_within(const Eigen::Vector3d& wanted,
                                         const Eigen::Vector3d& most) noexcept {
  double share = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double size = std::abs(wanted[i]);
    if (size > most[i]) share = std::min(share, most[i] / size);
  }
  return share;
}

}  // namespace reckon::haptics
