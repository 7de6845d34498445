// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A position that keeps its groups, so that one decision finds them once.
#pragma once

#include <optional>

#include "reckon/aoim/cells/cell_partition.hpp"

namespace reckon::aoim {

/// A position [m, S], and its groups as far as they were found. Valid until the next step of the
/// manager, because leaders may hand out other groups.
struct RoutedPosition {
  RoutedPosition(const Position& at = {}) noexcept : position(at) {}  // NOLINT: meant to convert
  RoutedPosition(double x, double y, double z) noexcept : position{x, y, z} {}

  /// The fixed group of its cell.
  [[nodiscard]] GroupIndex cell_in(const CellPartition& cells) const noexcept {
    if (!cell) cell = cells.group(position);
    return *cell;
  }

  Position position;
  mutable std::optional<GroupIndex> cell;
  mutable std::optional<GroupIndex> group;  ///< of the updates for all peers of the cell
};

}  // namespace reckon::aoim
