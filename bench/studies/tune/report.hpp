// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon tune` says: the table, the recommendation in words and as TOML, JSON Lines, CSV, and
// the curve as a picture.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reckon/bench/studies/force/force_study.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/bench/studies/tune/tuning.hpp"

namespace reckon::bench {

/// Which row to take, and why.
struct Advice {
  const TuneRow* row = nullptr;  ///< null: nothing reaches what was asked for
  std::string why;               ///< "the knee of the curve"
};

/// All that there is to say about the motion of a file.
struct TuneReport {
  const TrackFile& file;
  const TrackSummary& summary;
  const TuneOptions& options;
  const TuneTable& table;
  Advice advice;
};

/// For people. `all`: every row, not only the front and the advice.
[[nodiscard]] std::string tune_text(const TuneReport& report, bool all);
/// One object a line: the settings, the baselines, the recommendation.
[[nodiscard]] std::string tune_json(const TuneReport& report);
[[nodiscard]] std::string tune_csv(const TuneReport& report);
/// Packets against p99 error, a curve for each model; knee, advice and baseline marked.
[[nodiscard]] std::string tune_svg(const TuneReport& report);

/// What the rows of a force say; `contact`: those of a contact by its force model.
[[nodiscard]] std::string force_text(std::span<const ForceRow> rows, bool contact);
[[nodiscard]] std::string force_json(std::span<const ForceRow> rows);
[[nodiscard]] std::string force_csv(std::span<const ForceRow> rows);

}  // namespace reckon::bench
