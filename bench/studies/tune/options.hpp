// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The words of `reckon tune`, as typed and as numbers.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/tune/tuning.hpp"
#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::bench {

/// As typed.
struct TuneWords {
  std::string file, models, thresholds, angle, error, budget, jitter, loss, plot, columns, floor;
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(5);
  std::optional<std::chrono::nanoseconds> delay;
  std::chrono::nanoseconds span = std::chrono::seconds(60);
  std::optional<std::uint64_t> seed;
  bool force = false, all = false, json = false, csv = false;

  void declare(tools::CommandLine& line);
};

/// What to aim at; at most one is set.
struct TuneGoal {
  std::optional<double> error;          ///< p99 [m]
  std::optional<double> packets_per_s;  ///< of all entities
};

/// All of these throw UsageError with the word and the remedy.
[[nodiscard]] TuneGoal goal_of(const TuneWords& words);
/// `step`: way between samples [m], for the ladder; `has_orientation`: of the file. Where a goal of
/// error is set the ladder reaches it.
[[nodiscard]] TuneOptions options_of(const TuneWords& words, const TuneGoal& goal, double step,
                                     bool has_orientation);
/// Names between commas.
[[nodiscard]] std::vector<std::string> list_of(std::string_view text);
/// `text` in `unit` between the bounds; `fallback` where it is empty.
[[nodiscard]] double quantity_of(std::string_view flag, std::string_view text,
                                 std::string_view unit, double least, double most, double fallback);

}  // namespace reckon::bench
