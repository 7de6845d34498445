// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds, for each change at one servo, the first step of the other whose force shows it. Pure.
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

/// What became of the changes.
struct TouchTimes {
  std::vector<std::chrono::nanoseconds> taken;  ///< from the change to the step that shows it
  std::size_t missed = 0;                       ///< not shown before the next change
};

/// @param changes of the cause, each with the value that the force then goes to. @param forces of
/// the other servo, by time. A change shows where the force is nearer to its new value than to the
/// one before, having been farther at the last step before the change. The first change only sets
/// the value to come from.
[[nodiscard]] TouchTimes match_touches(std::span<const StepSample> changes,
                                       std::span<const StepSample> forces);

}  // namespace reckon::bench
