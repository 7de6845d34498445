// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_torques.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace reckon::haptics {

Eigen::Vector3d levers_of(const Eigen::Matrix3d& jacobian) noexcept {
  const Eigen::Matrix3d squares = jacobian.transpose() * jacobian;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> turns;
  turns.computeDirect(squares, Eigen::EigenvaluesOnly);
  return turns.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

double paid_share(const UsbForce& force, const Eigen::Vector3d& torques) noexcept {
  const double asked = torques.norm(), paid = force.lever * force.force.norm();
  return asked > paid ? paid / asked : 1.0;
}

double share_within(const Eigen::Vector3d& wanted, const Eigen::Vector3d& most) noexcept {
  double share = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double size = std::abs(wanted[i]);
    if (size > most[i]) share = std::min(share, most[i] / size);
  }
  return share;
}

}  // namespace reckon::haptics
