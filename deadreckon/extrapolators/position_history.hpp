// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Position-history-based dead reckoning (PHBDR): only positions travel, and the receiver takes
// velocity and acceleration from the last three. Thesis 4.4, after Singhal and Cheriton.
#pragma once

#include "reckon/deadreckon/extrapolators/multi_step.hpp"

namespace reckon::deadreckon {

/// Between which accelerations the second order is used.
struct AccelerationCutoffs {
  /// Below this [m/s^2] acceleration is noise and the first order is taken. Default 0.1, >= 0.
  double minimal = 0.1;
  /// Above this [m/s^2] the motion is taken for abrupt, a turn on the spot or a jump, which does
  /// not go on; first order. Default 20, > minimal.
  double substantial = 20.0;
};

/// x' + v tau + a tau^2 / 2 with v and a of the parabola through the last three positions; the
/// first order through the last two where |a| is minimal or substantial (the thesis names that case
/// only; the second order between the cut-offs is the method as its authors use it). Fewer samples,
/// short gaps and long silences: as first_order_two_step, which holds without a usable gap where no
/// velocity is sent. Any thread, no allocation.
[[nodiscard]] Pose position_history(const MotionHistory& history, double tau,
                                    const StepLimits& limits,
                                    const AccelerationCutoffs& cutoffs) noexcept;

/// With the default cut-offs.
[[nodiscard]] Pose position_history(const MotionHistory& history, double tau,
                                    const StepLimits& limits) noexcept;

}  // namespace reckon::deadreckon
