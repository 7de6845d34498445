// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace reckon::peer {
namespace {

constexpr std::uint8_t kDeepest = 15;

std::size_t most_numbers(const AoimConfig& config) {
  return config.hand_out ? aoim::kMaximumPool : config.pool;
}

std::uint16_t place_of(const std::vector<LocaleConfig>& locales, const std::string& name,
                       const std::string& of) {
  const auto found = std::ranges::find(locales, name, &LocaleConfig::name);
  if (found == locales.end())
    throw std::invalid_argument(
        fmt::format("'{}' names the neighbour '{}', which does not exist", of, name));
  return static_cast<std::uint16_t>(found - locales.begin());
}

void add_neighbour(aoim::Locale& locale, std::uint16_t other) {
  if (std::ranges::find(locale.neighbours, other) == locale.neighbours.end())
    locale.neighbours.push_back(other);
}

aoim::LocaleMap locale_map(const std::vector<LocaleConfig>& said) {
  std::vector<aoim::Locale> locales(said.size());
  std::set<std::string> names;
  for (const LocaleConfig& locale : said)
    if (!names.insert(locale.name).second)
      throw std::invalid_argument(fmt::format("there are two locales '{}': keep one", locale.name));
  for (std::size_t i = 0; i < said.size(); ++i) {
    const LocaleConfig& locale = said[i];
    locales[i].origin = {locale.origin.x(), locale.origin.y(), locale.origin.z()};
    locales[i].yaw = locale.yaw;
    locales[i].half_x = 0.5 * locale.size.x();
    locales[i].half_y = 0.5 * locale.size.y();
    if (locale.size.z() > 0.0) locales[i].half_z = 0.5 * locale.size.z();
    // Either of two neighbours may name the other.
    for (const std::string& name : names_in(locale.neighbours)) {
      const std::uint16_t other = place_of(said, name, locale.name);
      if (other == i)
        throw std::invalid_argument(fmt::format("'{}' names itself as a neighbour", name));
      add_neighbour(locales[i], other);
      add_neighbour(locales[other], static_cast<std::uint16_t>(i));
    }
  }
  for (aoim::Locale& locale : locales) std::ranges::sort(locale.neighbours);
  return aoim::LocaleMap(std::move(locales));
}

}  // namespace

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    std::string name = list.substr(at, comma - at);
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    names.push_back(std::move(name));
    at = comma + 1;
  }
  return names;
}

aoim::QuadTreeConfig quad_tree_config(const AoimConfig& config) {
  const QuadTreeConfig& said = config.quad_tree;
  aoim::QuadTreeConfig tree;
  tree.centre = {said.centre.x(), said.centre.y(), 0.0};
  tree.side = said.side;
  tree.pool = said.most > 0 ? said.most : most_numbers(config);
  tree.depth = 0;
  for (double side = said.side; side / 2 >= said.smallest && tree.depth < kDeepest; side /= 2)
    ++tree.depth;
  return tree;
}

std::vector<aoim::CellId> divided_by(const AoimConfig& config,
                                     std::span<const aoim::Demand> places) {
  std::vector<aoim::Demand> demands(places.begin(), places.end());
  for (aoim::Demand& demand : demands) demand.radius *= kTreeLeave;
  const auto tree = aoim::QuadTree::divided_by(quad_tree_config(config), demands);
  return {tree.leaves().begin(), tree.leaves().end()};
}

std::optional<aoim::CellPartition> uneven_cells(const AoimConfig& config) {
  if (config.scheme == aoim::CellScheme::locales) return locale_map(config.locales);
  if (config.scheme != aoim::CellScheme::quad_tree) return {};
  return aoim::QuadTree::of_cells(quad_tree_config(config), config.quad_tree.cells);
}

aoim::CellPartition cells_of(const AoimConfig& config) {
  if (auto uneven = uneven_cells(config)) return *uneven;
  return aoim::CellGrid({config.scheme, config.cell, most_numbers(config)});
}

}  // namespace reckon::peer
