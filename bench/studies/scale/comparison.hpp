// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compares two builds: the rows of a run with the rows that an earlier run wrote by --json.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/text.hpp"

namespace reckon::bench {

/// A row of an earlier run.
struct BaseRow {
  std::string mechanism;
  std::size_t peers = 0, entities = 0;
  std::map<std::string, double, std::less<>> values;  ///< by ScaleMeasure::name
};

/// Reads the lines of kind "row" of a file. @throws UsageError with file, line and remedy; also if
/// there is no such line
[[nodiscard]] std::vector<BaseRow> read_scale_rows(const std::string& path);

/// A number that has changed between two builds.
struct ScaleChange {
  std::string_view mechanism, measure;
  std::size_t peers = 0, entities = 0;
  double before = 0, now = 0;

  /// now / before; 1 if both are 0, infinite if only `before` is 0.
  [[nodiscard]] double ratio() const;
};

/// Numbers outside the range of the base by more than 2 %, largest change first. The base may hold
/// several runs of an exercise. CPU time of the library's code is compared if the base has two runs
/// or more, and counts from 10 % on. CPU time of the kernel is not compared. `before` is the
/// nearest value of that range.
[[nodiscard]] std::vector<ScaleChange> changes_of(std::span<const ScaleRow> rows,
                                                  std::span<const BaseRow> base);

/// @throws UsageError for an exercise that the base lacks; lists the exercises of the base
void check_same_exercises(std::span<const ScaleSetting> settings, std::span<const BaseRow> base,
                          std::string_view file);

[[nodiscard]] std::string comparison_text(std::span<const ScaleRow> rows,
                                          std::span<const BaseRow> base);
/// A line of kind "change" for each.
[[nodiscard]] std::string comparison_json(std::span<const ScaleRow> rows,
                                          std::span<const BaseRow> base);

}  // namespace reckon::bench
