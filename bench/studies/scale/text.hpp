// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study of scale as tables and JSON Lines.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// One mechanism more, in one exercise.
struct ScaleRow {
  std::size_t mechanism = 0;  ///< of kMechanisms, with those before it
  WholeRun run;

  [[nodiscard]] std::size_t peers() const noexcept { return run.setting.peers; }
  [[nodiscard]] std::size_t entities() const noexcept { return run.setting.crowd.entities; }
};

/// A number of a row as files and pages name it.
struct ScaleMeasure {
  std::string_view name;         ///< key of JSON, with unit
  std::string_view title;        ///< of a column of the wide table
  std::string_view short_title;  ///< of the narrow one; empty: it has none
  double (*of)(const ScaleRow&);
};

/// THE list of what is told of a row, each of one peer on average where nothing else is said.
[[nodiscard]] std::span<const ScaleMeasure> scale_measures();
/// @param name of one of them
[[nodiscard]] const ScaleMeasure& scale_measure(std::string_view name);

/// A value of it with its unit, for people.
[[nodiscard]] std::string measure_text(const ScaleMeasure& measure, double value);

/// A wide table for each exercise, and what its columns mean.
[[nodiscard]] std::string scale_text(std::span<const ScaleRow> rows);
/// In 80 columns: the largest exercise mechanism by mechanism with what each bought and cost, then
/// all mechanisms together, exercise by exercise.
[[nodiscard]] std::string scale_summary(std::span<const ScaleRow> rows);
/// A line for each row.
[[nodiscard]] std::string scale_json(std::span<const ScaleRow> rows);

}  // namespace reckon::bench
