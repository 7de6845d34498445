// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/scene_cells_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reckon/aoim/cells/over_delivery.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/tracks/density_file.hpp"

namespace reckon::tools {
namespace {

using peer::format_quantity;

std::string tree_text(const aoim::QuadTree& tree) {
  std::map<std::int32_t, std::size_t> sizes;
  for (const aoim::CellId leaf : tree.leaves()) ++sizes[leaf.r];
  std::string text = fmt::format("quad-tree of {} cells in a square of {}:", tree.cells(),
                                 format_quantity(tree.config().side, "m"));
  for (const auto& [depth, count] : sizes)
    text += fmt::format("{} {} of {}", depth == sizes.begin()->first ? "" : ",", count,
                        format_quantity(tree.side(depth), "m"));
  return text;
}

std::string locales_text(const aoim::LocaleMap& map) {
  double longest = 0.0;
  std::size_t ways = 0;
  for (const aoim::Locale& locale : map.locales()) {
    longest = std::max({longest, 2.0 * locale.half_x, 2.0 * locale.half_y});
    ways += locale.neighbours.size();
  }
  return fmt::format("{} locales of {} to {}, with {} connections", map.locales().size(),
                     format_quantity(map.finest(), "m"), format_quantity(longest, "m"), ways / 2);
}

}  // namespace

std::string cells_text(const peer::AoimConfig& aoim) {
  const aoim::CellPartition cells = peer::cells_of(aoim);
  if (const auto* tree = cells.as<aoim::QuadTree>()) return tree_text(*tree);
  if (const auto* map = cells.as<aoim::LocaleMap>()) return locales_text(*map);
  return fmt::format("{}, {}", peer::word_of(aoim.scheme), format_quantity(aoim.cell, "m"));
}

std::string over_delivery_text(const peer::AoimConfig& aoim) {
  const aoim::CellPartition cells = peer::cells_of(aoim);
  const auto* tree = cells.as<aoim::QuadTree>();
  if (tree == nullptr || aoim.quad_tree.density.empty()) return {};
  const auto places = peer::read_density(aoim.quad_tree.density, aoim.quad_tree.reach);
  // Squares that cover the same area with the same number of groups.
  const double across = std::max(1.0, std::floor(std::sqrt(static_cast<double>(tree->cells()))));
  const double side = tree->config().side / across;
  const aoim::CellGrid equal({aoim::CellScheme::square, side, aoim::kMaximumPool});
  return fmt::format(
      "for {} sampled positions, {:.2f} times the entities within {}; {:.2f} times with equal "
      "squares of {}",
      places.size(), over_delivery(cells, places), format_quantity(aoim.quad_tree.reach, "m"),
      over_delivery(equal, places), format_quantity(side, "m"));
}

}  // namespace reckon::tools
