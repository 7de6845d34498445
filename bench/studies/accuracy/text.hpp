// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Results of the pose studies as tables, CSV and JSON Lines.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/accuracy/circle_study.hpp"
#include "reckon/bench/studies/accuracy/equal_error.hpp"
#include "reckon/bench/studies/accuracy/study.hpp"
#include "reckon/bench/studies/contact/contact_study.hpp"

namespace reckon::bench {

/// All inputs and results of a study of accuracy.
struct AccuracyReport {
  std::string command;    ///< as typed
  std::string processor;  ///< of the query times; empty: not measured
  AccuracyGrid grid;      ///< with the thresholds of the last subject
  std::vector<AccuracyResult> results;
  std::vector<ContactRow> contacts;  ///< usually empty
};

/// Indices of the rows by octets/s, then error; with `front_only` only rows on the front.
[[nodiscard]] std::vector<std::size_t> rows_in_order(const AccuracyResult& result, bool front_only);

/// For example "80 ms +-40 %, 10 % lost, medians of 20 seeds from 1", and the other common
/// settings.
[[nodiscard]] std::string conditions_text(const AccuracyGrid& grid);

/// The tables and their explanations, at most 100 columns wide.
[[nodiscard]] std::string accuracy_text(const AccuracyReport& report, bool front_only);

/// Titles and one row a setting; lengths in metres, angles in radians.
[[nodiscard]] std::string accuracy_csv(const AccuracyReport& report, bool front_only);

/// A line for the study, one for each subject and one for each setting.
[[nodiscard]] std::string accuracy_json(const AccuracyReport& report, bool front_only);

/// The table of a page, with every setting.
[[nodiscard]] std::string accuracy_page_table(const AccuracyResult& result);
/// One HTML file: for each subject the front as a picture, and the table, which can be sorted.
[[nodiscard]] std::string accuracy_page(const AccuracyReport& report);

[[nodiscard]] std::string circle_lines(std::span<const CircleRow> rows, bool json);

/// A file and the result for it.
struct NamedEqualError {
  std::string subject;
  EqualError found;
};
[[nodiscard]] std::string equal_error_table(std::span<const NamedEqualError> rows);
[[nodiscard]] std::string equal_error_json(std::span<const NamedEqualError> rows);

}  // namespace reckon::bench
