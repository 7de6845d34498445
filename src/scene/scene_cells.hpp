// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts [aoim] into the cells that all peers of a scene share.
#pragma once

#include <optional>
#include <span>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/peer/settings/aoim_config.hpp"

namespace reckon::peer {

/// A group of a quad-tree is left beyond this multiple of the radius. Its cells are smallest where
/// most entities are, so a late leave costs more than with equal cells.
inline constexpr double kTreeLeave = 1.05;

/// The cells of a scheme with unequal cells, else nothing.
/// @throws std::invalid_argument with the remedy, from aoim::QuadTree and aoim::LocaleMap, for two
/// locales with one name and an unknown neighbour.
[[nodiscard]] std::optional<aoim::CellPartition> uneven_cells(const AoimConfig& config);
/// The cells of any scheme; if a leader assigns the groups, with the maximum number of cells.
/// @throws std::invalid_argument as above, and from aoim::CellGrid.
[[nodiscard]] aoim::CellPartition cells_of(const AoimConfig& config);
/// The names in a list such as "hall, room 2".
[[nodiscard]] std::vector<std::string> names_in(const std::string& list);

/// The square and its division.
[[nodiscard]] aoim::QuadTreeConfig quad_tree_config(const AoimConfig& config);
/// The cells of the tree with the least waste for traffic at these places. For set-up, up to some
/// seconds.  @throws std::invalid_argument from aoim::QuadTree
[[nodiscard]] std::vector<aoim::CellId> divided_by(const AoimConfig& config,
                                                   std::span<const aoim::Demand> places);

}  // namespace reckon::peer
