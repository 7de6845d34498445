// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What turns: wrenches of the probes of a rigid tool, and axes of different damping as one port. A
// port of six axes is EnergyPortOf<6> in the coordinates of DampedAxes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "reckon/haptics/passivity/split.hpp"

namespace reckon::haptics {

/// Force [N], then torque about the handle [N m]; a motion is [m], then [rad]. Frame S.
using Wrench = AxisForces<6>;
using WrenchCurvature = Eigen::Matrix<double, 6, 6>;

/// Of a force at one place of a tool: torque = r x f. @param r from the handle [m]  @param f [N]
[[nodiscard]] inline Wrench wrench_of(const Eigen::Vector3d& r, const Eigen::Vector3d& f) noexcept {
  Wrench wrench;
  wrench << f, r.cross(f);
  return wrench;
}

/// A tool turns by at most this within a sample [rad]: 20 rad/s at 1 kHz.
inline constexpr double kMostTurn = 0.02;

/// Upper bound of the curvature, in the six motions of a rigid tool, of a potential at one place of
/// it, for turns up to kMostTurn: J^T K J, and what the bend of the way of a probe that turns adds
/// (at most |r| turn^2 / 2 off the straight way).
/// @param r [m]  @param stiffness of the potential [N/m], symmetric, >= 0  @param f its force [N]
[[nodiscard]] inline WrenchCurvature curvature_of(const Eigen::Vector3d& r,
                                                  const Eigen::Matrix3d& stiffness,
                                                  const Eigen::Vector3d& f) noexcept {
  Eigen::Matrix<double, 3, 6> motion;  // of the probe
  motion.leftCols<3>().setIdentity();
  motion.rightCols<3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  WrenchCurvature curvature = motion.transpose() * stiffness * motion;
  // With e off the straight way u: -f e + u K e + e K e / 2, where |e| <= |r| turn^2 / 2.
  const double lever = r.norm(), most = stiffness.norm() * kMostTurn;
  curvature.diagonal().head<3>().array() += 0.5 * most;
  curvature.diagonal().tail<3>().array() +=
      lever * f.norm() + (1.5 + 0.25 * kMostTurn) * most * lever * lever;
  return curvature;
}

/// Axes of a device, scaled so that each has a damping of 1: forces by 1 / sqrt(b), motions by
/// sqrt(b). Work and loss stay what they are, so that a port of one damping serves all axes.
template <int axes>
class DampedAxes {
 public:
  using Force = AxisForces<axes>;
  using Curvature = Eigen::Matrix<double, axes, axes>;

  /// @param damping of each axis, > 0 [N s/m; N m s/rad]
  explicit DampedAxes(const Force& damping) noexcept : root_(damping.cwiseSqrt()) {}

  [[nodiscard]] Force scaled_force(const Force& force) const noexcept {
    return force.cwiseQuotient(root_);
  }
  [[nodiscard]] Force scaled_motion(const Force& motion) const noexcept {
    return motion.cwiseProduct(root_);
  }
  /// Of a scaled force.
  [[nodiscard]] Force force(const Force& scaled) const noexcept {
    return scaled.cwiseProduct(root_);
  }
  /// Greatest curvature in scaled axes [1/s]: as PortLoadOf takes it. @param curvature symmetric
  [[nodiscard]] double slope(const Curvature& curvature) const noexcept {
    const Force inverse = root_.cwiseInverse();
    const Curvature scaled = inverse.asDiagonal() * curvature * inverse.asDiagonal();
    return std::max(0.0, Eigen::SelfAdjointEigenSolver<Curvature>(scaled, Eigen::EigenvaluesOnly)
                             .eigenvalues()
                             .maxCoeff());
  }

 private:
  Force root_;
};

}  // namespace reckon::haptics
