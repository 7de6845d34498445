// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Updates that one model saves against another at the same error: the threshold at which it has the
// same p99, and its updates there.
#pragma once

#include <span>

#include "reckon/bench/studies/accuracy/study.hpp"

namespace reckon::bench {

struct EqualError {
  PoseModel baseline, rival;
  double baseline_threshold = 0;  ///< [m]
  PoseResult baseline_result;
  /// The rival's tried threshold with the fewest updates whose p99 is not above the baseline's; 0
  /// if there is none.
  double threshold = 0;
  PoseResult result;

  /// Share of the baseline's updates that the rival saves; negative if it needs more.
  [[nodiscard]] double saving() const noexcept {
    const auto base = static_cast<double>(baseline_result.updates);
    return base > 0 ? 1 - static_cast<double>(result.updates) / base : 0;
  }
};

/// Tries thresholds from a tenth to a thousand times the baseline's, 12 a decade, and then finer
/// steps around the best: the error does not always grow with the threshold. Convergence, angle,
/// heartbeat and network are from the grid. Deterministic; about 70 runs.
[[nodiscard]] EqualError find_equal_error(std::span<const Track> tracks, const AccuracyGrid& grid,
                                          const PoseModel& baseline, double threshold,
                                          const PoseModel& rival, const StudyProgress& go_on = {});

}  // namespace reckon::bench
