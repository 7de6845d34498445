// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The display of a correction: the error of a prediction does not jump but decays to zero over a
// short time.
//
// The error (shown minus predicted) of position, velocity, orientation and angular velocity is
// stored at the update. The shown pose is the new prediction plus that error times a curve. With
// the cubic it has no step in position, velocity, orientation or angular velocity, at any update.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// Curves of the decay. u = t/Tc, e0 is the error and f0 its rate at the update, g0 the
/// acceleration of the previous error:
enum class ConvergenceCurve : std::uint8_t {
  snap,        ///< At once: a step of e0.
  linear,      ///< e0 (1-u): continuous, velocity kinks at both ends.
  quadratic,   ///< e0 (1-u^2) + f0 Tc u(1-u): velocity kinks at the end only, by 2|e0|/Tc + |f0|.
  projective,  ///< e0 (1-u) + f0 Tc u(1-u)^2: projective velocity blending; kinks by |e0|/Tc.
  cubic,       ///< e0 (1-3u^2+2u^3) + f0 Tc u(1-u)^2: continuous in velocity (C1). The default.
  /// e0 (1-10u^3+15u^4-6u^5) + f0 Tc (u-6u^3+8u^4-3u^5) + g0 Tc^2 u^2(1-u)^3/2: also continuous in
  /// acceleration (C2) where the predictions are. Without g0 an error would outlast updates that
  /// come faster than Tc: each would restart it without any acceleration towards zero.
  quintic
};

/// Weights of e0, f0 and g0, and their rates, at one time of a curve.
struct ConvergenceWeights {
  double error = 0;              ///< Multiplies e0.
  double rate = 0;               ///< Multiplies f0 [s].
  double error_rate = 0;         ///< d/dt of `error` [1/s].
  double rate_rate = 0;          ///< d/dt of `rate`.
  double acceleration = 0;       ///< Multiplies g0 [s^2]; only for the quintic.
  double acceleration_rate = 0;  ///< d/dt of `acceleration` [s].
};

/// Guaranteed bounds of a curve for the largest |e0| and |f0| of an update without an earlier error
/// (g0 = 0). g0 adds at most 0.0174 |g0| Tc^2 and 0.068 |g0| Tc.
struct ConvergenceCurveRow {
  ConvergenceCurve curve;
  std::string_view name;
  int continuity;  ///< Derivatives of the shown pose without a step at an update: -1 none, 0
                   ///< pose...
  /// |e| <= error_bound |e0| + rate_bound |f0| Tc.
  double error_bound, rate_bound;
  /// |e'| <= speed_error |e0| / Tc + speed_rate |f0|.
  double speed_error, speed_rate;
  /// |e| <= near_bound H if a threshold is known. H is the largest of the threshold and of the
  /// changes of the prediction by updates whose errors still decay.
  double near_bound;
};

/// THE list of the curves, in the order of the enumeration.
inline constexpr std::array<ConvergenceCurveRow, 6> kConvergenceCurves{{
    {ConvergenceCurve::snap, "snap", -1, 0, 0, 0, 0, 0},
    {ConvergenceCurve::linear, "linear", 0, 1, 0, 1, 0, 1},
    {ConvergenceCurve::quadratic, "quadratic", 0, 1, 0.25, 2, 1, 1.334},
    {ConvergenceCurve::projective, "projective", 0, 1, 4.0 / 27, 1, 1, 1.068},
    {ConvergenceCurve::cubic, "cubic", 1, 1, 4.0 / 27, 1.5, 1, 1.16},
    {ConvergenceCurve::quintic, "quintic", 2, 1, 16.0 / 81, 1.875, 1, 1.33},
}};

/// Weights `elapsed` seconds after the update, of `duration` > 0 seconds; all zero past the end.
[[nodiscard]] ConvergenceWeights convergence_weights(ConvergenceCurve curve, double elapsed,
                                                     double duration) noexcept;

struct ConvergenceSettings {
  static constexpr double kLeastDuration = 0.02;  ///< [s], of `duration` if it is not 0
  static constexpr double kMostDuration = 2.0;    ///< [s]
  ConvergenceCurve curve = ConvergenceCurve::cubic;
  /// Tc [s], default 0.1. A longer one is smoother but shows the wrong place for longer. A shorter
  /// one turns a large error into a large speed: 1.5 |e0| / Tc. 0 is the same as snap. If updates
  /// come faster, Tc is 1.5 times the time since the last one, but at least `shortest`.
  double duration = 0.1;
  /// Position error [m] above which the entity counts as moved on purpose and is shown at the new
  /// place at once. Default 10 m; raise it for fast vehicles over poor links.
  double teleport_distance = 10.0;
  /// Limit [s] for the duration of a large error, which gets more time than `duration` so that its
  /// correction looks like motion and not like a throw. The cubic's 1.5 |e0| / Tc then stays below
  /// the larger of gentle_speed and gentle_share of the entity's speed, and 1.5 |turn| / Tc below
  /// gentle_turn. The duration is also at most 1.5 times the time since the last update: otherwise
  /// the shown pose would never catch up. Default 1 s; `duration` or less disables this.
  double longest = 1.0;
  double gentle_speed = 2.0;  ///< [m/s] > 0
  double gentle_share = 0.1;  ///< >= 0
  double gentle_turn = 2.0;   ///< [rad/s] > 0
  /// The same as teleport_distance for the angle [rad]; the default pi disables it.
  double teleport_angle = 3.141592653589793;
  /// Least Tc at any rate of updates [s], but not above `duration`. Default 0.02: a frame.
  double shortest = 0.02;
  /// Thresholds of the owners for their copies [m], [rad], > 0. If known, the shown pose stays near
  /// the prediction, see ConvergingError. Default: unknown, Tc is as above.
  double threshold = std::numeric_limits<double>::infinity();
  double threshold_angle = std::numeric_limits<double>::infinity();
};

/// The shown error of one remote entity. Times are seconds of one steady clock of the caller.
/// Updates may come at any rate: an update during a decay starts from the shown pose, and errors
/// still decay.
///
/// If a threshold is known, an error lasts at most for the time in which it would grow by 2 H at
/// its present rate (H as in ConvergenceCurveRow). So a prediction that turns away from the shown
/// pose does not drag it along. Errors of several updates do not add up either: the part above H
/// and above the previous error is dropped at once. Only this is a step. It is no larger than the
/// change of the prediction by the update, and occurs only if that change is at most two
/// thresholds, as it is without loss.
///
/// Not synchronised. No allocation; a query costs about 40 ns while converging. The caller passes
/// the settings, the same at each call, because many entities share them.
class ConvergingError {
 public:
  /// A new prediction is used from `now` on. `shown` is the result of shown() from the old
  /// prediction at this `now`, `predicted` the new one. Errors above the teleport distance or
  /// angle, or not finite, are dropped: the new prediction is shown at once.
  void restart(const ConvergenceSettings& settings, const Pose& shown, const Pose& predicted,
               double now) noexcept;

  /// The pose to show at `now`, with consistent velocities, for the present prediction at that
  /// `now`.
  [[nodiscard]] Pose shown(const Pose& predicted, double now) const noexcept;

  /// Whether there is still an error at `now`.
  [[nodiscard]] bool converging(double now) const noexcept;

  /// Shows the plain predictions from now on.
  void snap() noexcept { active_ = false; }
  /// The same for an update at `now`.
  void snap(double now) noexcept {
    active_ = false;
    started_ = true;
    start_ = now;
  }

  /// Tc of the present error [s].
  [[nodiscard]] double duration() const noexcept { return duration_; }

 private:
  void carry_acceleration(double now) noexcept;
  // Remainder of the present error.
  struct Left {
    Eigen::Vector3d error = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  };
  [[nodiscard]] Left left_at(double now) const noexcept;
  // `turn`: the exponential of turn_.
  void keep_near(const ConvergenceSettings& settings, const Eigen::Quaterniond& turn,
                 const Left& left) noexcept;

  Eigen::Vector3d error_ = Eigen::Vector3d::Zero();       // shown minus predicted [m]
  Eigen::Vector3d error_rate_ = Eigen::Vector3d::Zero();  // [m/s]
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();        // predicted to shown, body axes [rad]
  Eigen::Vector3d turn_rate_ = Eigen::Vector3d::Zero();   // d/dt of turn_ [rad/s]
  // Acceleration of the previous error, [m/s^2] and [rad/s^2]; quintic only.
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_acceleration_ = Eigen::Vector3d::Zero();
  double most_ = 0, most_turn_ = 0;  // bounds of errors during this decay [m], [rad]
  double duration_ = 0;              // Tc of this error
  double start_ = 0;
  ConvergenceCurve curve_ = ConvergenceCurve::snap;
  bool started_ = false;  // start_ is the time of an update
  bool active_ = false;
};

/// A ConvergingError with its own settings.
class PoseConvergence {
 public:
  explicit PoseConvergence(const ConvergenceSettings& settings = {}) noexcept
      : settings_(settings) {}

  void restart(const Pose& shown, const Pose& predicted, double now) noexcept {
    error_.restart(settings_, shown, predicted, now);
  }
  [[nodiscard]] Pose shown(const Pose& predicted, double now) const noexcept {
    return error_.shown(predicted, now);
  }
  [[nodiscard]] bool converging(double now) const noexcept { return error_.converging(now); }
  void snap() noexcept { error_.snap(); }
  [[nodiscard]] double duration() const noexcept { return error_.duration(); }
  [[nodiscard]] const ConvergenceSettings& settings() const noexcept { return settings_; }

 private:
  ConvergenceSettings settings_;
  ConvergingError error_;
};

}  // namespace reckon::deadreckon
