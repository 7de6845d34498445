// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon tune`: the table, the recommendation in words and as TOML, JSON Lines, CSV, and
// the curve as a picture.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reckon/bench/studies/force/force_study.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/bench/studies/tune/tuning.hpp"

namespace reckon::bench {

/// The recommended row, and the reason.
struct Advice {
  const TuneRow* row = nullptr;  ///< null: no row meets the goal
  std::string why;               ///< "the knee of the curve"
};

/// All results for the motion in a file.
struct TuneReport {
  const TrackFile& file;
  const TrackSummary& summary;
  const TuneOptions& options;
  const TuneTable& table;
  Advice advice;
};

/// For people. `all`: every row, not only the front and the recommendation.
[[nodiscard]] std::string tune_text(const TuneReport& report, bool all);
/// One object a line: the settings, the baselines, the recommendation.
[[nodiscard]] std::string tune_json(const TuneReport& report);
[[nodiscard]] std::string tune_csv(const TuneReport& report);
/// Packets against p99 error, one curve for each model; knee, recommendation and baseline are
/// marked.
[[nodiscard]] std::string tune_svg(const TuneReport& report);

/// The rows of a force as text; `contact`: rows of a contact by its force model.
[[nodiscard]] std::string force_text(std::span<const ForceRow> rows, bool contact);
[[nodiscard]] std::string force_json(std::span<const ForceRow> rows);
[[nodiscard]] std::string force_csv(std::span<const ForceRow> rows);

}  // namespace reckon::bench
