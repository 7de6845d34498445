// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study of scale as tables and JSON Lines.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/scale/setting.hpp"

namespace reckon::bench {

/// One mechanism more, in one exercise.
struct ScaleRow {
  ScaleSetting setting;
  std::size_t mechanism = 0;  ///< of kMechanisms, with those before it
  ScaleCounts counts;
};

/// A number of a row as files and pages name it.
struct ScaleMeasure {
  std::string_view name;   ///< key of JSON, with unit
  std::string_view title;  ///< of a column
  double (*of)(const ScaleRow&);
};

/// THE list of what is told of a row, each of one peer on average where nothing else is said.
[[nodiscard]] std::span<const ScaleMeasure> scale_measures();

/// A value of it with its unit, for people.
[[nodiscard]] std::string measure_text(const ScaleMeasure& measure, double value);

/// A table for each exercise, and what its columns mean.
[[nodiscard]] std::string scale_text(std::span<const ScaleRow> rows);
/// A line for each row.
[[nodiscard]] std::string scale_json(std::span<const ScaleRow> rows);

}  // namespace reckon::bench
