// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Wrenches of the probes of a rigid tool, and scaling of axes with different damping for one port.
// A port of six axes is EnergyPortOf<6> in the coordinates of DampedAxes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "reckon/haptics/passivity/split.hpp"

namespace reckon::haptics {

/// Force [N], then torque about the handle [N m]; a motion is [m], then [rad]. Frame S.
using Wrench = AxisForces<6>;
using WrenchCurvature = Eigen::Matrix<double, 6, 6>;

/// Wrench of a force at a point of a tool: torque = r x f. @param r from the handle [m] @param f
/// [N]
[[nodiscard]] inline Wrench wrench_of(const Eigen::Vector3d& r, const Eigen::Vector3d& f) noexcept {
  Wrench wrench;
  wrench << f, r.cross(f);
  return wrench;
}

/// Greatest rotation of a tool within a sample [rad]: 20 rad/s at 1 kHz.
inline constexpr double kMostTurn = 0.02;

/// Upper bound of the curvature of a potential at a point of a rigid tool, in its six coordinates,
/// for rotations up to kMostTurn: J^T K J plus the effect of the curved path of a rotating probe
/// (at most |r| turn^2 / 2 off the straight path).
/// @param r [m]  @param stiffness of the potential [N/m], symmetric, >= 0  @param f its force [N]
[[nodiscard]] inline WrenchCurvature curvature_of(const Eigen::Vector3d& r,
                                                  const Eigen::Matrix3d& stiffness,
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

/// The six axes of a device, scaled so that each has a damping of 1: forces by 1 / sqrt(b), motions
/// by sqrt(b). Work and loss do not change, so a port with one damping serves all axes.
class DampedAxes {
 public:
  /// @param damping of each axis, > 0 [N s/m; N m s/rad]
  explicit DampedAxes(const Wrench& damping) noexcept : root_(damping.cwiseSqrt()) {}

  [[nodiscard]] Wrench scaled_force(const Wrench& force) const noexcept {
    return force.cwiseQuotient(root_);
  }
  [[nodiscard]] Wrench scaled_motion(const Wrench& motion) const noexcept {
    return motion.cwiseProduct(root_);
  }
  /// Converts a scaled force back.
  [[nodiscard]] Wrench force(const Wrench& scaled) const noexcept {
    return scaled.cwiseProduct(root_);
  }
  /// Greatest curvature in scaled axes [1/s], for PortLoadOf. @param curvature symmetric
  [[nodiscard]] double slope(const WrenchCurvature& curvature) const noexcept {
    const Wrench inverse = root_.cwiseInverse();
    const WrenchCurvature scaled = inverse.asDiagonal() * curvature * inverse.asDiagonal();
    return std::max(0.0,
                    Eigen::SelfAdjointEigenSolver<WrenchCurvature>(scaled, Eigen::EigenvaluesOnly)
                        .eigenvalues()
                        .maxCoeff());
  }

 private:
  Wrench root_;
};

}  // namespace reckon::haptics
