// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy that the friction of a device has certainly dissipated, from readings of its handle.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace reckon::haptics {

/// Over a displacement D in a time t a viscous friction b dissipates at least b |D|^2 / t, whatever
/// the motion (Cauchy-Schwarz). With an encoder of step h, |D| may be less by sqrt(axes) h: a
/// handle that seems to jump a step now and then moved slowly meanwhile. So motion is divided into
/// stretches of sixteen steps, and their loss is booked as it becomes certain. In slow motion a
/// fifth is not credited.
template <int axes>
class SureDampingOf {
 public:
  /// @param damping b [N s/m] >= 0  @param resolution h [m] >= 0; 0 reads exactly
  SureDampingOf(double damping, double resolution) noexcept
      : damping_(damping), unsure_(std::sqrt(axes) * resolution), stretch_(kSteps * resolution) {}

  /// The handle moved by `dx` [m] in `dt` [s] > 0. @return the energy that became certain [J] >= 0.
  [[nodiscard]] double move(const Eigen::Matrix<double, axes, 1>& dx, double dt) noexcept {
    if (!(unsure_ > 0)) return damping_ * dx.squaredNorm() / dt;
    way_ += dx;
    time_ += dt;
    const double length = way_.norm();
    const double sure = length > unsure_ ? length - unsure_ : 0.0;
    const double loss = damping_ * sure * sure / time_;
    const double gain = loss > booked_ ? loss - booked_ : 0.0;
    booked_ += gain;
    if (length >= stretch_) begin();
    return gain;
  }
  /// The path of the handle is unknown: restarts.
  void begin() noexcept {
    way_.setZero();
    time_ = booked_ = 0.0;
  }

  [[nodiscard]] double damping() const noexcept { return damping_; }

 private:
  static constexpr double kSteps = 16.0;

  double damping_;
  double unsure_;   // [m]
  double stretch_;  // [m]
  Eigen::Matrix<double, axes, 1> way_ = Eigen::Matrix<double, axes, 1>::Zero();
  double time_ = 0.0;
  double booked_ = 0.0;
};

using SureDamping = SureDampingOf<3>;

}  // namespace reckon::haptics
