// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a cell partition on a sample of positions: updates received over updates wanted.
#pragma once

#include <span>

#include "reckon/aoim/cells/cell_partition.hpp"

namespace reckon::aoim {

/// Each demand sends once and joins the cells within its radius. Returns the number of updates in
/// the joined groups over the number of updates from within the radius, or 0 if there are none. For
/// set-up: some ns for each pair of demands of one instant, some 50 ns for each cell.
[[nodiscard]] double over_delivery(const CellPartition& cells, std::span<const Demand> demands);

}  // namespace reckon::aoim
