// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/wrench.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace reckon::haptics {

WrenchCurvature curvature_of(const Eigen::Vector3d& r, const Eigen::Matrix3d& stiffness,
                             const Eigen::Vector3d& f) noexcept {
  Eigen::Matrix<double, 3, 6> motion;  // of the probe
  motion.leftCols<3>().setIdentity();
  motion.rightCols<3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  WrenchCurvature curvature = motion.transpose() * stiffness * motion;
  // With the deviation e from the straight path u: -f e + u K e + e K e / 2, where |e| <= |r|
  // turn^2 / 2.
  const double lever = r.norm(), most = stiffness.norm() * kMostTurn;
  curvature.diagonal().head<3>().array() += 0.5 * most;
  curvature.diagonal().tail<3>().array() +=
      lever * f.norm() + (1.5 + 0.25 * kMostTurn) * most * lever * lever;
  return curvature;
}

double DampedAxes::slope(const WrenchCurvature& curvature) const noexcept {
  const Wrench inverse = root_.cwiseInverse();
  const WrenchCurvature scaled = inverse.asDiagonal() * curvature * inverse.asDiagonal();
  return std::max(0.0,
                  Eigen::SelfAdjointEigenSolver<WrenchCurvature>(scaled, Eigen::EigenvaluesOnly)
                      .eigenvalues()
                      .maxCoeff());
}

}  // namespace reckon::haptics
