// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exact motion of one degree of freedom between samples: a mass with damping under a held force,
// and a one-sided stop whose time of impact is computed. Thesis 3.3. Off-line code.
#pragma once

#include <optional>

namespace reckon::bench {

/// m v' + b v = f.
struct MassDamper {
  double mass = 1.0;     ///< [kg] > 0
  double damping = 0.0;  ///< [N s/m] >= 0
};

struct MotionState {
  double position = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
};

/// State after `time` [s] >= 0 under a constant force [N]: closed form, exact to rounding for any b
/// >= 0, including 0 and values near 0.
[[nodiscard]] MotionState advanced(const MassDamper& body, const MotionState& state, double force,
                                   double time) noexcept;

/// First instant in [0, horizon] [s] at which a body that starts at or above `stop` reaches it from
/// above, if there is one. A body at the stop: 0 if it moves or is pushed down. Exact to rounding:
/// the path has curvature of one sign, so that Newton's method inside a bracket cannot miss the
/// crossing.
[[nodiscard]] std::optional<double> first_contact(const MassDamper& body, const MotionState& state,
                                                  double force, double stop,
                                                  double horizon) noexcept;

/// A stop that the body cannot pass: position >= this position.
struct RigidStop {
  double position = 0.0;     ///< [m]
  double restitution = 1.0;  ///< speed after over speed before, 0 to 1
  /// Impacts slower than this [m/s] end the bouncing: the body rests while it is pushed against the
  /// stop. A ball with restitution below 1 bounces infinitely often in a finite time.
  double rest_speed = 1e-9;
};

/// A body above a stop, under a force held for any length of time.
///
///     HybridMotion ball({1.0, 0.0}, {1.0, 0.0}, RigidStop{});
///     ball.run(-9.81, 3600.0);               // thousands of bounces, each at its own instant
class HybridMotion {
 public:
  /// @throws std::invalid_argument for a mass not above 0, damping below 0, a start below the stop,
  /// restitution outside [0, 1], or numbers that are not finite
  HybridMotion(const MassDamper& body, const MotionState& start, const RigidStop& stop);

  /// @param force [N]  @param duration [s] >= 0
  void run(double force, double duration);
  /// Moves until the next impact is over. Returns false without a motion if there is no impact
  /// within `horizon` [s].
  bool run_to_impact(double force, double horizon);

  [[nodiscard]] const MotionState& state() const noexcept { return state_; }
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] long impacts() const noexcept { return impacts_; }
  /// Energy lost in impacts so far [J] >= 0.
  [[nodiscard]] double lost_in_impacts() const noexcept { return lost_; }

 private:
  void bounce();
  [[nodiscard]] bool rests(double force) const noexcept;

  MassDamper body_;
  MotionState state_;
  RigidStop stop_;
  double time_ = 0.0, lost_ = 0.0;
  long impacts_ = 0;
};

}  // namespace reckon::bench
