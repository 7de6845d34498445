// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Parses values of an axis, such as "0..200ms/5" or "0, 20, 50 ms", and selects rows of a list by
// name.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// The values that an axis allows.
struct ValueRule {
  std::string_view unit;  ///< in the form of peer::parse_quantity: "s", "N/m", "" for shares
  double least = 0, most = 0;
  bool open = false;  ///< `least` itself is not allowed
};

/// Number of values of a range without /N.
inline constexpr std::size_t kRangeValues = 5;
inline constexpr std::size_t kMostValues = 1000;

/// "A..B/N": N evenly spaced values including both ends; without /N kRangeValues. "A, B, C": a
/// list; a part may be a range. A number without a unit takes the unit of the next one that has
/// one; if none has one, it is in SI units. Order as typed. @param where start of an error message:
/// "--sweep delay"
/// @throws UsageError with the value and the remedy, also for a value given twice
[[nodiscard]] std::vector<double> read_values(std::string_view text, const ValueRule& rule,
                                              std::string_view where);

/// The parts of `text` between commas, without surrounding blanks.
[[nodiscard]] std::vector<std::string_view> parts_between_commas(std::string_view text);

/// @param where start of the message: the flag @param more text after the known names, for example
///     ", all"
/// @throws UsageError with the nearest of the known names
[[noreturn]] void refuse_name(std::string_view where, std::string_view name,
                              std::span<const std::string_view> known, std::string_view more = "");

template <typename Row>
[[nodiscard]] const Row& row_named(std::string_view name, std::span<const Row> rows,
                                   std::string_view flag) {
  std::vector<std::string_view> names;
  for (const Row& row : rows) {
    if (row.name == name) return row;
    names.push_back(row.name);
  }
  refuse_name(flag, name, names);
}

/// Several names in one word, separated by commas, or in several words; "all" or no word selects
/// every row.
template <typename Row>
[[nodiscard]] std::vector<Row> rows_named(std::span<const std::string> words,
                                          std::span<const Row> rows, std::string_view flag) {
  std::vector<Row> chosen;
  if (words.empty()) chosen.assign(rows.begin(), rows.end());
  for (const std::string& word : words)
    for (const std::string_view name : parts_between_commas(word)) {
      if (name == "all")
        chosen.insert(chosen.end(), rows.begin(), rows.end());
      else
        chosen.push_back(row_named(name, rows, flag));
    }
  return chosen;
}

}  // namespace reckon::bench
