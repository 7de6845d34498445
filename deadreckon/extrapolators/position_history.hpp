// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Position-history-based dead reckoning (PHBDR): only positions are sent, and the receiver derives
// velocity and acceleration from the last three. Thesis 4.4, after Singhal and Cheriton.
#pragma once

#include "reckon/deadreckon/extrapolators/multi_step.hpp"

namespace reckon::deadreckon {

/// Range of accelerations for the second order.
struct AccelerationCutoffs {
  /// A lower acceleration [m/s^2] is noise: first order. Default 0.1, >= 0.
  double minimal = 0.1;
  /// A higher acceleration [m/s^2] is an abrupt motion that does not continue, such as a turn on
  /// the spot or a jump: first order. Default 20, > minimal.
  double substantial = 20.0;
};

/// x' + v tau + a tau^2 / 2, with v and a of the parabola through the last three positions. The
/// first order through the last two is used where |a| is minimal or substantial. (The thesis
/// describes only the first order; the second order between the cut-offs is from Singhal and
/// Cheriton.) With fewer samples, short gaps or long silences it behaves as first_order_two_step,
/// which holds the position if there is no usable gap and no sent velocity. Any thread, no
/// allocation.
[[nodiscard]] Pose position_history(const MotionHistory& history, double tau,
                                    const StepLimits& limits,
                                    const AccelerationCutoffs& cutoffs) noexcept;

/// The same with the default cut-offs.
[[nodiscard]] Pose position_history(const MotionHistory& history, double tau,
                                    const StepLimits& limits) noexcept;

}  // namespace reckon::deadreckon
