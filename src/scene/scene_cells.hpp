// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From what [aoim] says to the cells that all peers of a scene have.
#pragma once

#include <optional>
#include <span>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/peer/scene/peer_config.hpp"

namespace reckon::peer {

/// A group of a quad-tree is left beyond this times the radius: its cells are as small as they are
/// where most are, so that lingering costs more than with equal cells.
inline constexpr double kTreeLeave = 1.05;

/// The cells where they are not equal ones, else nothing.
/// @throws std::invalid_argument, with the remedy, as aoim::QuadTree and aoim::LocaleMap do, for
/// two locales of one name and a neighbour that there is not.
[[nodiscard]] std::optional<aoim::CellPartition> uneven_cells(const AoimConfig& config);
/// Those of any scheme; where groups are handed out, as many numbers of cells as there can be.
/// @throws as above, and std::invalid_argument as aoim::CellGrid does.
[[nodiscard]] aoim::CellPartition cells_of(const AoimConfig& config);
/// The names in a list, as in "hall, room 2".
[[nodiscard]] std::vector<std::string> names_in(const std::string& list);

/// How the square is to be divided.
[[nodiscard]] aoim::QuadTreeConfig quad_tree_config(const AoimConfig& config);
/// The cells of the tree that wastes least of what is said at these places. For set-up, up to some
/// seconds. @throws std::invalid_argument as aoim::QuadTree
[[nodiscard]] std::vector<aoim::CellId> divided_by(const AoimConfig& config,
                                                   std::span<const aoim::Demand> places);

}  // namespace reckon::peer
