// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What turns: wrenches of the probes of a rigid tool, and axes of different damping as one port. A
// port of six axes is EnergyPortOf<6> in the coordinates of DampedAxes.
#pragma once

#include <Eigen/Core>

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
[[nodiscard]] WrenchCurvature curvature_of(const Eigen::Vector3d& r,
                                           const Eigen::Matrix3d& stiffness,
                                           const Eigen::Vector3d& f) noexcept;

/// The six axes of a device, scaled so that each has a damping of 1: forces by 1 / sqrt(b), motions
/// by sqrt(b). Work and loss stay what they are, so that a port of one damping serves all axes.
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
  /// Of a scaled force.
  [[nodiscard]] Wrench force(const Wrench& scaled) const noexcept {
    return scaled.cwiseProduct(root_);
  }
  /// Greatest curvature in scaled axes [1/s]: as PortLoadOf takes it. @param curvature symmetric
  [[nodiscard]] double slope(const WrenchCurvature& curvature) const noexcept;

 private:
  Wrench root_;
};

}  // namespace reckon::haptics
