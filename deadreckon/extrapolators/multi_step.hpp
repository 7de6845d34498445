// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One-step and two-step extrapolation, thesis (4.17) to (4.20): with the rates that were sent, or
// with those that follow from the last two updates. `tau` [s] = now - time of the newest update.
//
// A difference of two positions turns their rounding and noise e into an error e (1 + tau/gap):
// with float32 positions, a gap of 1/30 s and tau = 1 s that is 15 m. Hence the guards.
#pragma once

#include "reckon/deadreckon/motion/motion_history.hpp"

namespace reckon::deadreckon {

/// When two updates tell a rate.
struct StepLimits {
  /// Gap between updates [s] below which their difference says nothing; the one-step formula is
  /// taken. Default 1 ms, > 0.
  double shortest_gap = 1e-3;
  /// A rate from a gap is used for this many gaps at most; then the pose holds. Default 10, > 0.
  /// Raising it follows longer silences and multiplies noise.
  double most_gaps = 10;
};

/// Order 0: the newest position, for ever.
[[nodiscard]] Pose hold(const MotionHistory& history, double tau,
                        const StepLimits& limits) noexcept;

/// (4.17): x' + v' tau.
[[nodiscard]] Pose first_order_one_step(const MotionHistory& history, double tau,
                                        const StepLimits& limits) noexcept;

/// (4.18): x' + (x' - x'') / (t' - t'') tau.
[[nodiscard]] Pose first_order_two_step(const MotionHistory& history, double tau,
                                        const StepLimits& limits) noexcept;

/// (4.19): x' + v' tau + a' tau^2 / 2.
[[nodiscard]] Pose second_order_one_step(const MotionHistory& history, double tau,
                                         const StepLimits& limits) noexcept;

/// (4.20): x' + v' tau + (v' - v'') / (t' - t'') tau^2 / 2.
[[nodiscard]] Pose second_order_two_step(const MotionHistory& history, double tau,
                                         const StepLimits& limits) noexcept;

/// x' + v' tau + a' tau^2 / 2 + (a' - a'') / (t' - t'') tau^3 / 6: one order more than a sender of
/// accelerations tells. After most_gaps it goes on with the acceleration that was sent.
[[nodiscard]] Pose third_order_two_step(const MotionHistory& history, double tau,
                                        const StepLimits& limits) noexcept;

// All of them: a history of at least one sample (the identity pose without one); orientation by the
// rate that was sent in one-step formulas, by the turn between the last two orientations (the
// shorter way) in two-step ones. Finite for every float32 and any tau; NaN tau counts as 0. Any
// thread, no allocation, 10 to 60 ns.

/// Gap between the two newest samples where it is long enough to tell a rate, else 0 [s].
[[nodiscard]] double usable_gap(const MotionHistory& history, const StepLimits& limits) noexcept;

}  // namespace reckon::deadreckon
