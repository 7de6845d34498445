// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rows in columns for a terminal, and texts for their cells. Used by every verb that prints a
// table.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// A table that is collected first and then printed, each column as wide as its widest cell.
class TextTable {
 public:
  enum class Align : unsigned char { left, right };
  struct Column {
    std::string title;
    Align align = Align::left;
  };

  explicit TextTable(std::vector<Column> columns);
  /// Missing cells are empty; too many cells are an error of the caller.
  void add(std::vector<std::string> cells);
  /// Titles first, two spaces between columns, no spaces at the end of a line.
  void print(std::FILE* out) const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool empty() const { return rows_.empty(); }

 private:
  [[nodiscard]] std::vector<std::size_t> widths() const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Columns of UTF-8 text on a terminal (code points; wide and combining ones are not
/// distinguished).
[[nodiscard]] std::size_t text_width(std::string_view utf8);

/// The first `columns` columns of UTF-8 text. Control characters, which would move the cursor,
/// become dots.
[[nodiscard]] std::string cut_to(std::string_view utf8, std::size_t columns);

/// Wraps a sentence at `columns`, between words where possible; further lines are indented by two.
/// @param columns >= 8
[[nodiscard]] std::vector<std::string> wrap(std::string_view utf8, std::size_t columns);

/// A count with its noun: "1 error", "2 errors".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view noun);

/// A distance as text: "0.21 mm", "1.4 m", "12 km"; "0" below 10 um.
[[nodiscard]] std::string distance_text(double metres);

/// An angle as text: "0.21 deg", "14 deg"; "0" below 0.001 deg.
[[nodiscard]] std::string angle_text(double degrees);

/// Received octets made safe for a terminal: octets other than printable ASCII become dots.
[[nodiscard]] std::string printable_text(std::string_view text);

}  // namespace reckon::tools
