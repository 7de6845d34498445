// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which of its studies `reckon bench accuracy` runs, and which flags each of them takes: one that a
// study would not look at is refused.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "reckon/bench/studies/accuracy/options.hpp"

namespace reckon::bench {

/// The studies, each a bit of the table of flags.
enum class AccuracyMode : std::uint8_t {
  poses = 1,
  forces = 2,
  poses_and_forces = 4,
  against = 8,
  circle = 16,
  trace = 32,
  touch = 64,
};

/// The study that was asked for. Of two that exclude one another the first of trace, circle,
/// against and touch; check_flags() then names the other.
[[nodiscard]] AccuracyMode mode_of(const BenchOptions& options);

/// @param given as CommandLine::given(). @throws UsageError with the first flag that the study does
/// not look at, and the remedy.
void check_flags(AccuracyMode mode, std::span<const std::string> given,
                 const BenchOptions& options);

}  // namespace reckon::bench
