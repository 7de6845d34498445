// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a rendered surface follows its prediction: closely on a LAN, calmly over a long line.
#pragma once

#include <Eigen/Core>

namespace reckon::haptics {

/// What is followed.
struct Following {
  bool alone = false;      ///< no other hand is touched, by us or by it, and neither lacks energy
  double stiffness = 0.0;  ///< [N/m] of the contact, >= 0
  /// New stiffness over what is shown of it in this step. With it the forces of old and new are
  /// blended; a place and a stiffness that go their ways by themselves meet in more than either.
  double weight = 1.0;
  bool played = false;  ///< it is no extrapolation: closely, whatever the line
  double share = 1.0;   ///< most of the error that is taken up in this step
};

/// Second-order follower c of a prediction c*: c moves by a filtered velocity u and takes up the
/// rest of the error with time constant tau; u follows the prediction's velocity with 2 tau. So a
/// surface in steady motion has no lag, and a step (an update) is spread over tau.
///
/// D is the smoothed age of updates on arrival, plus the interval between them (20 ms at most):
/// what the coupling of two hands over this line has as delay. tau = 2 D within 2..100 ms. Where
/// two hands are alone with each other, neither lacks energy, stiffness x age is below 4.5 N s/m,
/// about what devices and grips damp, and updates come often (every 19.5 ms, or every 10 ms where
/// they are more than 2.5 ms old), tau is shorter: the age once more and D, as a share of 1400 N/m;
/// 3 ms at least, and so long that what updates usually miss by is taken up at 20 mm/s. Rows of
/// hands would ring so, stiff ones over longer lines too, and steps that come seldom are felt as
/// such. Whatever the surface does, the port's energy answers for it: this rule decides quality,
/// never passivity.
/// docs/haptic_stability.md has the trials.
class SurfaceTracker {
 public:
  /// Starts at rest with nothing known of the line.
  void reset() noexcept { *this = SurfaceTracker{}; }

  /// Learns from an accepted update. @param age [s] on arrival  @param interval [s] since the last
  /// one  @param miss [m] between the old prediction and the new one, where it is felt, else 0
  void learn(double age, double interval, double miss) noexcept;

  /// Where the rendered point should be after this step. @param predicted_before, predicted [m],
  /// the present record's prediction one step ago and now  @param shown [m], rendered one step ago
  [[nodiscard]] Eigen::Vector3d follow(const Eigen::Vector3d& predicted_before,
                                       const Eigen::Vector3d& predicted,
                                       const Eigen::Vector3d& shown, double dt,
                                       const Following& how) noexcept;

  /// The rendered point is put on the prediction, at its velocity [m/s].
  void snap(const Eigen::Vector3d& velocity) noexcept { velocity_ = velocity; }

  /// Takes back a share of what is faster along `normal`, towards our hand, than the prediction.
  void hold_back(const Eigen::Vector3d& normal, const Eigen::Vector3d& predicted_velocity,
                 double share) noexcept {
    const double faster = normal.dot(velocity_ - predicted_velocity);
    if (faster > 0) velocity_ -= share * faster * normal;
  }

  /// Smoothed age of updates on arrival [s].
  [[nodiscard]] double age() const noexcept { return age_; }

  /// D: that and the interval between updates [s].
  [[nodiscard]] double delay() const noexcept { return delay_; }

  /// [s], 0.002 .. 0.1.
  [[nodiscard]] double time_constant(const Following& how) const noexcept;

 private:
  double delay_ = 0.0;  // D [s]
  double age_ = 0.0;    // [s], the part of D that the line makes
  double miss_ = 0.0;   // [m], smoothed
  bool learnt_ = false;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // u [m/s]
};

}  // namespace reckon::haptics
