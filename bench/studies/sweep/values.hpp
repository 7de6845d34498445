// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Values of an axis as they are typed, "0..200ms/5", "0, 20, 50 ms"; and rows of a list by their
// names.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// What an axis may hold.
struct ValueRule {
  std::string_view unit;  ///< as peer::parse_quantity takes it: "s", "N/m", "" for shares
  double least = 0, most = 0;
  bool open = false;  ///< `least` itself is not good
};

/// Values of a range that says no number of them.
inline constexpr std::size_t kRangeValues = 5;
inline constexpr std::size_t kMostValues = 1000;

/// "A..B/N": N evenly spaced values, both ends among them; without /N kRangeValues. "A, B, C": a
/// list; a part may be a range. A number without a unit takes that of the next one that has one;
/// without any it is SI. Order as typed. @param where begins the text of an error: "--sweep delay"
/// @throws UsageError with the value and the remedy, for a value given twice too
[[nodiscard]] std::vector<double> read_values(std::string_view text, const ValueRule& rule,
                                              std::string_view where);

/// The parts of `text` between commas, without blanks about them.
[[nodiscard]] std::vector<std::string_view> parts_between_commas(std::string_view text);

/// @param where begins the text: the flag  @param more behind the known names, as in ", all"
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

/// Several in one word with commas between, or several words; "all" and no word: every row.
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
