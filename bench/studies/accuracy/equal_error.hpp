// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What one model saves against another at the same error: the threshold at which it shows the same
// p99, and the updates there.
#pragma once

#include <span>

#include "reckon/bench/studies/accuracy/study.hpp"

namespace reckon::bench {

struct EqualError {
  PoseModel baseline, rival;
  double baseline_threshold = 0;  ///< [m]
  PoseResult baseline_result;
  /// Of the rival's thresholds tried the one with the fewest updates whose p99 is not above the
  /// baseline's; 0 where there is none.
  double threshold = 0;
  PoseResult result;

  /// Share of the baseline's updates that the rival does without; negative where it needs more.
  [[nodiscard]] double saving() const noexcept {
    const auto base = static_cast<double>(baseline_result.updates);
    return base > 0 ? 1 - static_cast<double>(result.updates) / base : 0;
  }
};

/// Tries thresholds from a tenth to a thousand times the baseline's, 12 a decade, and then finer
/// about the best: the error need not grow with the threshold. Convergence, angle, heartbeat and
/// network are those of the grid. Deterministic; some 70 runs.
[[nodiscard]] EqualError find_equal_error(std::span<const Track> tracks, const AccuracyGrid& grid,
                                          const PoseModel& baseline, double threshold,
                                          const PoseModel& rival, const StudyProgress& go_on = {});

}  // namespace reckon::bench
