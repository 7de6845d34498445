// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Columns that fit the width of a terminal, for tables that are redrawn in place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {

/// A column and its rank: on a narrow terminal the columns of greatest rank are dropped first.
template <typename Cell>
struct FittedColumn {
  std::string_view title;
  TextTable::Align align;
  std::size_t width;  ///< minimum
  int rank;
  std::string (*text)(const Cell& cell);
  std::size_t more = 0;  ///< maximum extra width in a wide terminal
};

/// Rows of one kind: columns of the greatest rank are dropped until the rest fits. A row whose
/// texts are wider than their columns ends before the column that does not fit.
template <typename Cell, std::size_t N>
class FittedColumns {
 public:
  /// @param columns outlive it; at most one of them has `more`  @param room width of the terminal
  FittedColumns(const std::array<FittedColumn<Cell>, N>& columns, std::size_t room)
      : columns_(columns), room_(room) {
    for (std::size_t i = 0; i < N; ++i) shown_[i] = true;
    while (width() > room && widest_rank() > 0) {
      const int worst = widest_rank();
      for (std::size_t i = 0; i < N; ++i) shown_[i] = shown_[i] && columns_[i].rank != worst;
    }
    for (std::size_t i = 0; i < N; ++i)
      if (shown_[i] && room > width())
        more_ = std::max(more_, std::min(columns_[i].more, room - width()));
  }

  /// Extra width that the widening column gets.
  [[nodiscard]] std::size_t more() const { return more_; }

  [[nodiscard]] std::string titles() const {
    return line([](const FittedColumn<Cell>& column) { return std::string(column.title); });
  }
  [[nodiscard]] std::string row(const Cell& cell) const {
    return line([&](const FittedColumn<Cell>& column) { return column.text(cell); });
  }

 private:
  [[nodiscard]] std::size_t width() const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += shown_[i] ? columns_[i].width + 1 : 0;
    return sum - 1;
  }
  [[nodiscard]] int widest_rank() const {
    int rank = 0;
    for (std::size_t i = 0; i < N; ++i) rank = shown_[i] ? std::max(rank, columns_[i].rank) : rank;
    return rank;
  }
  template <typename Text>
  [[nodiscard]] std::string line(const Text& text_of) const {
    std::string line;
    std::size_t end = 0;  // end of the column if no text is too wide
    for (std::size_t i = 0; i < N; ++i) {
      if (!shown_[i]) continue;
      const std::string text = text_of(columns_[i]);
      const std::size_t begin = line.empty() ? 0 : line.size() + 1;
      if (!line.empty()) line += ' ';
      end += columns_[i].width + (columns_[i].more > 0 ? more_ : 0) + (end > 0 ? 1 : 0);
      const std::size_t padding = std::max(end, begin + text.size()) - begin - text.size();
      if (begin > 0 && begin + padding + text.size() > room_) break;
      if (columns_[i].align == TextTable::Align::right) line.append(padding, ' ');
      line += text;
      if (columns_[i].align == TextTable::Align::left) line.append(padding, ' ');
    }
    return line;
  }

  const std::array<FittedColumn<Cell>, N>& columns_;
  std::array<bool, N> shown_{};
  std::size_t room_, more_ = 0;
};

}  // namespace reckon::tools
