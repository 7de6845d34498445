// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a viewer sees when an update shows that the prediction was off: not a jump, but the error
// decaying to zero over a short time.
//
// Kept is the error (shown minus predicted) of position, velocity, orientation and angular velocity
// at the update; what is shown is the new prediction plus that error times a curve. With the cubic
// the shown pose has no step in position, velocity, orientation or angular velocity, at any update.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// How the error goes to zero. With u = t/Tc, e0 the error and f0 its rate at the update, and g0
/// what the error before was accelerating by:
enum class ConvergenceCurve : std::uint8_t {
  snap,        ///< At once: a jump of e0.
  linear,      ///< e0 (1-u): continuous, velocity kinks at both ends.
  quadratic,   ///< e0 (1-u^2) + f0 Tc u(1-u): velocity kinks at the end only, by 2|e0|/Tc + |f0|.
  projective,  ///< e0 (1-u) + f0 Tc u(1-u)^2: projective velocity blending; kinks by |e0|/Tc.
  cubic,       ///< e0 (1-3u^2+2u^3) + f0 Tc u(1-u)^2: continuous in velocity (C1). The default.
  /// e0 (1-10u^3+15u^4-6u^5) + f0 Tc (u-6u^3+8u^4-3u^5) + g0 Tc^2 u^2(1-u)^3/2: also in
  /// acceleration (C2) where the predictions are. Without g0 an error would outlive updates that
  /// come faster than Tc: each would start it anew without any acceleration towards zero.
  quintic
};

/// Share of e0, of f0, of g0, and their rates, at one instant of a curve.
struct ConvergenceWeights {
  double error = 0;              ///< Multiplies e0.
  double rate = 0;               ///< Multiplies f0 [s].
  double error_rate = 0;         ///< d/dt of `error` [1/s].
  double rate_rate = 0;          ///< d/dt of `rate`.
  double acceleration = 0;       ///< Multiplies g0 [s^2]; the quintic alone has it.
  double acceleration_rate = 0;  ///< d/dt of `acceleration` [s].
};

/// What a curve promises while an error goes to zero, for the largest |e0| and |f0| of an update
/// that finds no other error under way (g0 = 0); g0 adds at most 0.0174 |g0| Tc^2 and 0.068 |g0|
/// Tc.
struct ConvergenceCurveRow {
  ConvergenceCurve curve;
  std::string_view name;
  int continuity;  ///< Derivatives of the shown pose without a step at an update: -1 none, 0
                   ///< pose...
  /// |e| <= error_bound |e0| + rate_bound |f0| Tc.
  double error_bound, rate_bound;
  /// |e'| <= speed_error |e0| / Tc + speed_rate |f0|.
  double speed_error, speed_rate;
  /// |e| <= near_bound H where a threshold is known, H being the largest of the threshold and of
  /// what the updates whose errors are under way have moved the prediction by.
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
  static constexpr double kLeastDuration = 0.02;  ///< [s], of `duration` where it is not 0
  static constexpr double kMostDuration = 2.0;    ///< [s]
  ConvergenceCurve curve = ConvergenceCurve::cubic;
  /// Tc [s], default 0.1. Longer is smoother but shows the wrong place for longer;
  /// shorter turns a large error into a large speed: 1.5 |e0| / Tc. 0 is the same as snap. Where
  /// updates come faster, Tc is 1.5 times the time since the last one, but not below `shortest`.
  double duration = 0.1;
  /// Position error [m] from which the entity is taken to have been moved on purpose and is shown
  /// at the new place at once. Default 10 m; raise it for fast vehicles over poor links.
  double teleport_distance = 10.0;
  /// A large error is given more time than `duration`, up to this [s], so that its correction looks
  /// like motion and not like a throw: the cubic's 1.5 |e0| / Tc then stays below the larger of
  /// gentle_speed and gentle_share of the entity's speed, and 1.5 |turn| / Tc below gentle_turn.
  /// But not more than 1.5 times the time since the last update: an error that grew in so long is
  /// made good in so long, or what is shown would stay behind for ever. Default 1 s; `duration` or
  /// less for none.
  double longest = 1.0;
  double gentle_speed = 2.0;  ///< [m/s] > 0
  double gentle_share = 0.1;  ///< >= 0
  double gentle_turn = 2.0;   ///< [rad/s] > 0
  /// The same as teleport_distance for the angle [rad]; default pi: none is too large.
  double teleport_angle = 3.141592653589793;
  /// Tc at any rate of updates is not below this [s], nor above `duration`. Default 0.02: a frame.
  double shortest = 0.02;
  /// What owners let copies be off by before they send [m], [rad], > 0: what is shown then stays
  /// near the prediction, see ConvergingError. Default: not known, Tc is as above.
  double threshold = std::numeric_limits<double>::infinity();
  double threshold_angle = std::numeric_limits<double>::infinity();
};

/// The error of one remote entity, as shown. Times are seconds of one steady clock of the caller's.
/// Updates may come at any rate: one before the last error is gone starts from what is shown, and
/// errors die out all the same.
///
/// Where a threshold is known, no error is shown for longer than it would take to grow by 2 H at
/// its present rate (H as in ConvergenceCurveRow), so that a prediction that turns away from
/// what is shown does not carry it along. And errors of several updates do not add up: of what is
/// shown, that part is left out at once which is above H and above the error before; this alone is
/// a step, no larger than what the update has moved the prediction by, and only where that is two
/// thresholds at most, as it is when nothing is lost. Not synchronised. No allocation; a query
/// costs about 40 ns while converging. Settings are the caller's, the same at each call: many
/// entities share them.
class ConvergingError {
 public:
  /// A new prediction takes over at `now`: `shown` is what shown() gave from the old prediction at
  /// this same `now`, `predicted` what the new one says. Errors past the teleport distance or
  /// angle, or not finite, are dropped: the new prediction is shown at once.
  void restart(const ConvergenceSettings& settings, const Pose& shown, const Pose& predicted,
               double now) noexcept;

  /// The pose to show at `now` for the present prediction at that `now`, with consistent
  /// velocities.
  [[nodiscard]] Pose shown(const Pose& predicted, double now) const noexcept;

  /// Whether an error is still left at `now`.
  [[nodiscard]] bool converging(double now) const noexcept;

  /// Shows predictions as they are from now on.
  void snap() noexcept { active_ = false; }

  /// Tc of the present error [s].
  [[nodiscard]] double duration() const noexcept { return duration_; }

 private:
  void carry_acceleration(double now) noexcept;
  // What is left of the error under way.
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
  // Of the error that this one took over from, [m/s^2] and [rad/s^2]; quintic only.
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_acceleration_ = Eigen::Vector3d::Zero();
  double most_ = 0, most_turn_ = 0;  // what errors may be while these go away [m], [rad]
  double duration_ = 0;              // Tc of this error
  double start_ = 0;
  ConvergenceCurve curve_ = ConvergenceCurve::snap;
  bool started_ = false;  // start_ is the time of an update
  bool active_ = false;
};

/// A ConvergingError with settings of its own.
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
