// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a rendered surface follows its prediction: closely on a LAN, calmly over a long line.
#pragma once

#include <Eigen/Core>

namespace reckon::haptics {

/// Second-order follower c of a prediction c*: c moves by a filtered velocity u and takes up the
/// rest of the error with time constant tau; u follows the prediction's velocity with 2 tau. So a
/// surface in steady motion has no lag, and a step (an update) is spread over tau.
///
/// D is the smoothed age of updates on arrival, plus the interval between them (20 ms at most):
/// what the coupling of two hands over this line has as delay. tau = 2 D within 2..100 ms. Where
/// two hands are alone with each other, updates arrive within 2 ms, and none missed by more than
/// 0.2 mm in the last 5 s, tau = 0.35 D, 3 ms at least; rows of hands, and lines that lose, would
/// ring so. Whatever the surface does, the port's energy answers for it: this rule decides quality,
/// never passivity. docs/haptic_stability.md has the trials.
class SurfaceTracker {
 public:
  /// Starts at rest with nothing known of the line.
  void reset() noexcept { *this = SurfaceTracker{}; }

  /// Learns from an accepted update. @param age [s] on arrival  @param interval [s] since the last
  /// one  @param miss [m] between the old prediction and the new one
  void learn(double age, double interval, double miss) noexcept;

  /// Where the rendered point should be after this step. @param predicted_before, predicted [m],
  /// the present record's prediction one step ago and now  @param shown [m], rendered one step ago
  [[nodiscard]] Eigen::Vector3d follow(const Eigen::Vector3d& predicted_before,
                                       const Eigen::Vector3d& predicted,
                                       const Eigen::Vector3d& shown, double dt,
                                       bool alone) noexcept;

  /// The rendered point is put on the prediction, at its velocity [m/s].
  void snap(const Eigen::Vector3d& velocity) noexcept { velocity_ = velocity; }

  /// Smoothed age of updates on arrival [s].
  [[nodiscard]] double age() const noexcept { return age_; }

  /// D: that and the interval between updates [s].
  [[nodiscard]] double delay() const noexcept { return delay_; }

  /// [s], 0.002 .. 0.1. @param alone whether no other hand is touched
  [[nodiscard]] double time_constant(bool alone) const noexcept;

 private:
  double delay_ = 0.0;  // D [s]
  double age_ = 0.0;    // [s], the part of D that the line makes
  double calm_ = 0.0;   // [s], for so long nothing is followed closely
  bool learnt_ = false;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // u [m/s]
};

}  // namespace reckon::haptics
