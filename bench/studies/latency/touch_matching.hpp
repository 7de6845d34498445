// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds, for each change at one servo, the first step of the other whose force shows the change.
// Pure function.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

namespace reckon::bench {

/// One value at one servo step.
struct StepSample {
  std::chrono::nanoseconds time{0};
  double value = 0;
};

/// Result for all changes.
struct TouchTimes {
  std::vector<std::chrono::nanoseconds> taken;  ///< from the change to the step that shows it
  std::size_t missed = 0;                       ///< not shown before the next change
};

/// @param changes at the first servo, each with the resulting force. @param forces of the other
///     servo, by time. A change is visible as soon as the force is nearer to its new value than to
///     the previous one, if it was not at the last step before the change. The first change only
///     sets the initial value.
[[nodiscard]] TouchTimes match_touches(std::span<const StepSample> changes,
                                       std::span<const StepSample> forces);

}  // namespace reckon::bench
