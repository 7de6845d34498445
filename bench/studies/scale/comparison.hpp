// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two builds beside each other: the rows of a run and those that an earlier one wrote by --json.
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

/// The lines of kind "row" of a file. @throws UsageError with file, line and remedy; also where
/// there is none
[[nodiscard]] std::vector<BaseRow> read_scale_rows(const std::string& path);

/// A number that has changed between two builds.
struct ScaleChange {
  std::string_view mechanism, measure;
  std::size_t peers = 0, entities = 0;
  double before = 0, now = 0;

  /// now / before; 1 where both are 0, infinite where only the first is.
  [[nodiscard]] double ratio() const;
};

/// Numbers that are outside what the base has, which may hold several runs of an exercise, by more
/// than 2 %; the largest change first. CPU of the library's code counts where the base has two runs
/// or more, and differs by more than 10 %; that of the kernel does not count. `before` is the
/// nearest of the base.
[[nodiscard]] std::vector<ScaleChange> changes_of(std::span<const ScaleRow> rows,
                                                  std::span<const BaseRow> base);

/// @throws UsageError for an exercise that the base does not have, with those that it has
void check_same_exercises(std::span<const ScaleSetting> settings, std::span<const BaseRow> base,
                          std::string_view file);

[[nodiscard]] std::string comparison_text(std::span<const ScaleRow> rows,
                                          std::span<const BaseRow> base);
/// A line of kind "change" for each.
[[nodiscard]] std::string comparison_json(std::span<const ScaleRow> rows,
                                          std::span<const BaseRow> base);

}  // namespace reckon::bench
