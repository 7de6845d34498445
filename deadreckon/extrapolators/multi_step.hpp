// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One-step and two-step extrapolation, thesis (4.17) to (4.20): with the sent rates, or with rates
// from the last two updates. `tau` [s] = now - time of the newest update.
//
// A difference of two positions amplifies their rounding and noise e to e (1 + tau/gap): with
// float32 positions, a gap of 1/30 s and tau = 1 s that is 15 m. Therefore the limits below.
#pragma once

#include "reckon/deadreckon/motion/motion_history.hpp"

namespace reckon::deadreckon {

/// Limits for rates from two updates.
struct StepLimits {
  /// Gap between updates [s] below which their difference is not used; the one-step formula
  /// replaces it. Default 1 ms, > 0.
  double shortest_gap = 1e-3;
  /// Number of gaps for which a rate from a gap is used; after that the pose holds. Default 10, >
  /// 0. A higher value follows longer silences and amplifies noise.
  double most_gaps = 10;
};

/// Order 0: holds the newest position.
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

/// x' + v' tau + a' tau^2 / 2 + (a' - a'') / (t' - t'') tau^3 / 6: one order more than the sent
/// acceleration. After most_gaps it continues with the sent acceleration.
[[nodiscard]] Pose third_order_two_step(const MotionHistory& history, double tau,
                                        const StepLimits& limits) noexcept;

// All of them need a history of at least one sample; without one they return the identity pose.
// One-step formulas turn with the sent rate, two-step formulas with the rotation between the last
// two orientations (the shorter way). Finite for every float32 and any tau; NaN tau counts as 0.
// Any thread, no allocation, 10 to 60 ns.

/// Gap between the two newest samples if it is long enough for a rate, else 0 [s].
[[nodiscard]] double usable_gap(const MotionHistory& history, const StepLimits& limits) noexcept;

}  // namespace reckon::deadreckon
