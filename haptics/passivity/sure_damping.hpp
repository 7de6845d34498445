// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy that the friction of a device has certainly dissipated, from readings of its handle.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace reckon::haptics {

/// Over a displacement D in a time t, a viscous friction b dissipates at least b |D|^2 / t for any
/// motion (Cauchy-Schwarz). With an encoder of step h, |D| may be less by sqrt(axes) h: a handle
/// whose reading jumps a step now and then moves slowly. So motion is divided into stretches of
/// sixteen steps, and their loss is booked as it becomes certain. In slow motion a fifth is not
/// credited. If damping and step differ from pose to pose, the worst of a stretch counts.
template <int axes>
class SureDampingOf {
 public:
  /// @param damping b [N s/m] >= 0  @param resolution h [m] >= 0; 0 reads exactly
  SureDampingOf(double damping, double resolution) noexcept
      : damping_(damping),
        before_(damping),
        least_(damping),
        step_(resolution),
        step_before_(resolution),
        longest_(resolution) {}

  /// Sets damping and step at the pose of the next move(), until the next call.
  void pose(double damping, double resolution) noexcept {
    before_ = std::exchange(damping_, damping);
    step_before_ = std::exchange(step_, resolution);
    least_ = std::min(least_, damping);
    longest_ = std::max(longest_, resolution);
  }

  /// The handle moved by `dx` [m] in `dt` [s] > 0. @return the energy that became certain [J] >= 0.
  [[nodiscard]] double move(const Eigen::Matrix<double, axes, 1>& dx, double dt) noexcept {
    if (!(longest_ > 0)) return std::exchange(least_, damping_) * dx.squaredNorm() / dt;
    way_ += dx;
    time_ += dt;
    const double length = way_.norm(), unsure = std::sqrt(axes) * longest_;
    const double sure = length > unsure ? length - unsure : 0.0;
    const double loss = least_ * sure * sure / time_;
    const double gain = loss > booked_ ? loss - booked_ : 0.0;
    booked_ += gain;
    if (length >= kSteps * longest_) begin();
    return gain;
  }
  /// The path of the handle is unknown: restarts at the last pose.
  void begin() noexcept {
    way_.setZero();
    time_ = booked_ = 0.0;
    least_ = std::min(before_, damping_);
    longest_ = std::max(step_before_, step_);
  }

 private:
  static constexpr double kSteps = 16.0;

  double damping_, before_, least_;      // [N s/m], of this pose, the last one, the stretch
  double step_, step_before_, longest_;  // [m], the same
  Eigen::Matrix<double, axes, 1> way_ = Eigen::Matrix<double, axes, 1>::Zero();
  double time_ = 0.0;
  double booked_ = 0.0;
};

using SureDamping = SureDampingOf<3>;

}  // namespace reckon::haptics
