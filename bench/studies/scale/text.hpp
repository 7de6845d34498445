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

/// The run of an exercise with one mechanism more.
struct ScaleRow {
  std::size_t mechanism = 0;  ///< index in kMechanisms; all before it are on too
  WholeRun run;

  [[nodiscard]] std::size_t peers() const noexcept { return run.setting.peers; }
  [[nodiscard]] std::size_t entities() const noexcept { return run.setting.crowd.entities; }
};

/// A measure of a row, with its names in files and pages.
struct ScaleMeasure {
  std::string_view name;         ///< key of JSON, with unit
  std::string_view title;        ///< of a column of the wide table
  std::string_view short_title;  ///< of the narrow table; empty: not a column there
  double (*of)(const ScaleRow&);
};

/// THE list of measures of a row: means over the peers, unless stated otherwise.
[[nodiscard]] std::span<const ScaleMeasure> scale_measures();
/// @param name of one of them
[[nodiscard]] const ScaleMeasure& scale_measure(std::string_view name);

/// A value of the measure with its unit, readable.
[[nodiscard]] std::string measure_text(const ScaleMeasure& measure, double value);

/// A wide table for each exercise, and what its columns mean.
[[nodiscard]] std::string scale_text(std::span<const ScaleRow> rows);
/// In 80 columns: the largest exercise mechanism by mechanism, with the savings and costs of each;
/// then all mechanisms together, exercise by exercise.
[[nodiscard]] std::string scale_summary(std::span<const ScaleRow> rows);
/// A line for each row.
[[nodiscard]] std::string scale_json(std::span<const ScaleRow> rows);

}  // namespace reckon::bench
