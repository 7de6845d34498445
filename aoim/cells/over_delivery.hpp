// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What cells cost on a sample of where everybody was: how much more is heard than is wanted.
#pragma once

#include <span>

#include "reckon/aoim/cells/cell_partition.hpp"

namespace reckon::aoim {

/// Of places of which each speaks once and listens within its radius: what is said in the groups of
/// all cells within the radius, over what is said within the radius itself; 0 where that is
/// nothing. For set-up: some ns for each pair of demands of one instant, some 50 ns a cell.
[[nodiscard]] double over_delivery(const CellPartition& cells, std::span<const Demand> demands);

}  // namespace reckon::aoim
