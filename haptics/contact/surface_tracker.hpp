// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a rendered surface follows its prediction: closely on a LAN, calmly over a line with a long
// delay.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace reckon::haptics {

/// Inputs of one step.
struct Following {
  bool alone = false;      ///< no other hand is touched, by us or by it, and neither lacks energy
  double stiffness = 0.0;  ///< [N/m] of the contact, >= 0
  /// New stiffness over the stiffness shown in this step. With this weight the forces of old and
  /// new are blended. If place and stiffness changed separately, the force could exceed both.
  double weight = 1.0;
  bool played = false;  ///< a playback and no extrapolation: followed closely, whatever the line
  double share = 1.0;   ///< greatest share of the error corrected in this step
  bool in_row = false;  ///< another hand touches it too, or it is not the only one at ours
};

/// Second-order follower c of a prediction c*. c moves with a filtered velocity u and corrects the
/// rest of the error with time constant tau; u follows the prediction's velocity with 2 tau. So a
/// surface in steady motion has no lag, and a step (an update) is spread over tau.
///
/// D is the smoothed age of updates on arrival, plus the interval between them (20 ms at most). It
/// is the delay of the coupling of two hands over this line. tau = 2 D within 2..100 ms. Rows of
/// hands ring with a short tau; stiffer and longer rows ring more. Ringing causes more updates,
/// which shorten D further. So in a row tau is at least stiffness / (11 kN/m/s): 45
/// ms for 500 N/m. tau is shorter for two hands alone with each other if neither lacks energy,
/// stiffness x age is below 4.5 N s/m (about what devices and grips damp), and updates come often:
/// every 19.5 ms, or every 10 ms if they are more than 2.5 ms old. Then tau is the age plus D,
/// times stiffness / (1400 N/m). It is at least 3 ms, and long enough to correct the usual error of
/// updates at 20 mm/s. With a short tau stiff hands over longer lines would ring too, and seldom
/// steps are felt as such. The port's energy covers any motion of the surface: this rule decides
/// quality, never passivity. docs/haptic_stability.md has the trials.
class SurfaceTracker {
 public:
  /// Restarts at rest, with an unknown line.
  void reset() noexcept { *this = SurfaceTracker{}; }

  /// Takes an accepted update. @param age [s] on arrival  @param interval [s] since the last one
  /// @param miss [m] between the old prediction and the new one, if it is felt, else 0
  void learn(double age, double interval, double miss) noexcept {
    if (!std::isfinite(age) || !std::isfinite(interval)) return;
    const double line = std::clamp(age, 0.0, 1.0);
    const double waited = std::clamp(interval, 0.0, kLongestInterval);
    const double take = learnt_ ? kSmoothing : 1.0;
    age_ += take * (line - age_);
    delay_ += take * (line + waited - delay_);
    miss_ += take * (miss - miss_);
    learnt_ = true;
  }

  /// Place of the rendered point after this step. @param predicted_before, predicted [m], the
  /// present record's prediction one step ago and now  @param shown [m], rendered one step ago
  [[nodiscard]] Eigen::Vector3d follow(const Eigen::Vector3d& predicted_before,
                                       const Eigen::Vector3d& predicted,
                                       const Eigen::Vector3d& shown, double dt,
                                       const Following& how) noexcept {
    const double tau = time_constant(how);
    const Eigen::Vector3d wanted = (predicted - predicted_before) / dt;
    velocity_ += std::min(1.0, dt / (kVelocityRatio * tau)) * (wanted - velocity_);
    const Eigen::Vector3d moved = shown + velocity_ * dt;
    const double share = std::min(1.0, how.weight * std::min(how.share, dt / tau));
    return moved + share * (predicted - moved);
  }

  /// The rendered point is placed on the prediction, at its velocity [m/s].
  void snap(const Eigen::Vector3d& velocity) noexcept { velocity_ = velocity; }

  /// Removes a share of the velocity along `normal`, towards our hand, in excess of the
  /// prediction's.
  void hold_back(const Eigen::Vector3d& normal, const Eigen::Vector3d& predicted_velocity,
                 double share) noexcept {
    const double faster = normal.dot(velocity_ - predicted_velocity);
    if (faster > 0) velocity_ -= share * faster * normal;
  }

  /// Smoothed age of updates on arrival [s].
  [[nodiscard]] double age() const noexcept { return age_; }

  /// D: age plus the interval between updates [s].
  [[nodiscard]] double delay() const noexcept { return delay_; }

  /// [s], 0.002 .. 0.1.
  [[nodiscard]] double time_constant(const Following& how) const noexcept {
    if (how.played) return kPlayed;
    const double least = how.in_row ? how.stiffness / kRow : 0.0;
    const double calm = std::clamp(std::max(kDelaysPerTau * delay_, least), kShortest, kLongest);
    const double interval = delay_ - age_;
    const bool known = interval < (age_ < kNearAge ? kSeldom : kOften);
    if (!how.alone || !known || !(how.stiffness * age_ < kCloseCoupling)) return calm;
    const double coupling = how.stiffness / kStiff * (delay_ + age_);
    const double close = std::max({coupling, kShortestClose, miss_ / kPace});
    return std::min(close, calm);
  }

 private:
  static constexpr double kDelaysPerTau = 2.0;
  static constexpr double kShortest = 0.002;     // [s]
  static constexpr double kLongest = 0.1;        // [s]
  static constexpr double kRow = 11000.0;        // [N/m/s], stiffness over the least tau in a row
  static constexpr double kVelocityRatio = 2.0;  // time constant of u over tau
  static constexpr double kPlayed = 0.005;       // [s], for a playback
  static constexpr double kSmoothing = 0.2;      // weight of a new update
  static constexpr double kLongestInterval = 0.02;  // [s]
  // Close following, for one hand alone that is near.
  static constexpr double kStiff = 1400.0;         // [N/m]
  static constexpr double kShortestClose = 0.003;  // [s]
  static constexpr double kPace = 0.02;            // [m/s]
  static constexpr double kNearAge = 0.0025;       // [s]
  static constexpr double kOften = 0.01;           // [s]
  static constexpr double kSeldom = 0.0195;        // [s]
  static constexpr double kCloseCoupling = 4.5;    // [N s/m]

  double delay_ = 0.0;  // D [s]
  double age_ = 0.0;    // [s], part of D from the line
  double miss_ = 0.0;   // [m], smoothed
  bool learnt_ = false;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // u [m/s]
};

}  // namespace reckon::haptics
