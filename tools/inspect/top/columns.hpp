// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE lists of the data that the view `top` shows of an entity: columns for users, members for
// programs. A new one is one row in columns.cpp.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/listener/entity_table.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {

/// Input of a cell.
struct TopCell {
  TopCell(const EntityTable& all, std::size_t place, std::chrono::nanoseconds when)
      : table(all), entity(all.entities()[place]), row(all.rows()[place]), now(when) {}

  const EntityTable& table;
  const ReceivedEntity& entity;
  const EntityRow& row;
  std::chrono::nanoseconds now;
};

/// One column of the table.
struct TopColumn {
  std::string_view title;
  TextTable::Align align;
  std::string (*text)(const TopCell& cell);
  /// Sort key, largest first; null: no sorting by this column.
  double (*order)(const TopCell& cell);
};
[[nodiscard]] std::span<const TopColumn> top_columns();

/// One member of an entity's JSON object, and column of CSV.
struct TopMember {
  std::string_view key;
  bool is_text;
  std::string (*value)(const TopCell& cell);  ///< a number or "true"; empty: no value
};
[[nodiscard]] std::span<const TopMember> top_members();

/// Indices of the rows in the order of the column. Ties, and all rows of a column without a sort
/// key, are ordered by exercise and ID. `reverse` reverses the order.
[[nodiscard]] std::vector<std::size_t> top_order(const EntityTable& table,
                                                 std::chrono::nanoseconds now, std::size_t column,
                                                 bool reverse = false);

/// The cells of one entity, one for each column.
[[nodiscard]] std::vector<std::string> top_cells(const TopCell& cell);

}  // namespace reckon::tools
