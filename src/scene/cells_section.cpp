// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of [aoim] for cells of unequal size.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <numbers>
#include <sstream>

#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/tracks/density_file.hpp"

namespace reckon::peer {
namespace {

Section<QuadTreeConfig> quad_tree_section() {
  using Config = QuadTreeConfig;
  return {
      {
          {"centre", &Config::centre, within("m", -kWorld, kWorld),
           "centre of the square that is divided; height is ignored"},
          {"side", &Config::side, within("m", 0.01, kWorld),
           "side of that square; positions outside belong to the nearest cell"},
          {"smallest", &Config::smallest, within("m", 0.01, kWorld), "no cell has a shorter side"},
          {"most", &Config::most, within("", 0, aoim::kMaximumPool),
           "most cells; 0: one for each group, or 1000 with `hand_out`"},
          {"density", &Config::density,
           "sample of entity positions, CSV with x_m,y_m (or px_m,py_m) and, for several instants, "
           "t_s, beside the scene file; it divides cells whose peers would receive most from "
           "beyond `reach`"},
          {"reach", &Config::reach, declared("m", 0.01, kWorld),
           "with `density`: the usual `radius` of the peers"},
          {"leaves", &Config::leaves,
           "instead of `density`: each cell as its path of quarters (east 1, north 2), for example "
           "\"0 1 2 30 31 32 33\"; the rest of the square gets the largest possible cells"},
      },
      [](TomlReader& table, QuadTreeConfig&) {
        (void)only_one(table, {"density", "leaves"}, "where the square is divided");
        if (table.has("density")) table.require("reach");
        if (!table.has("density") && table.has("reach"))
          table.problem("reach", "'reach' needs 'density': add it, or remove 'reach'");
      }};
}

Section<LocaleConfig> locale_section() {
  using Config = LocaleConfig;
  return {{
              {"name", &Config::name, "required; unique, without commas"},
              {"origin", &Config::origin, within("m", -kWorld, kWorld),
               "centre, the origin of its own frame, in S"},
              {"yaw", &Config::yaw, within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi),
               "direction of its x axis, anticlockwise from east, seen from above"},
              {"size", &Config::size, within("m", 0, kWorld),
               "sides along its own x, y and z axes; z = 0 is any height"},
              {"neighbours", &Config::neighbours,
               "names of adjacent locales, for example \"hall, stairs\"; naming one in the other "
               "is enough"},
          },
          [](TomlReader& table, LocaleConfig& locale) {
            table.require("name");
            table.require("size");
            if (locale.name.find(',') != std::string::npos)
              table.problem("name",
                            "'name' has a comma, which separates names in 'neighbours': remove it");
            if (table.has("size") && locale.size.head<2>().minCoeff() <= 0)
              table.problem("size", "'size' is 0 along x or y: give the locale an area");
          }};
}

/// The cells in `leaves`; an invalid name is a problem.
std::vector<aoim::CellId> named_cells(TomlReader& table, const std::string& leaves) {
  std::vector<aoim::CellId> cells;
  std::istringstream words(leaves);
  for (std::string word; words >> word;) {
    const auto cell = aoim::QuadTree::cell_at(word);
    if (cell) {
      cells.push_back(*cell);
      continue;
    }
    table.problem(
        "quadtree",
        fmt::format(
            "'leaves' has \"{}\"; write up to 15 quarters 0 to 3 each, such as \"0 1 2 30\"",
            word));
    break;
  }
  return cells;
}

/// Divides the square, after its keys were checked.
void divide(TomlReader& table, AoimConfig& config) {
  QuadTreeConfig& tree = config.quad_tree;
  const bool limited = !config.hand_out && tree.most > config.pool;
  if (limited)
    return table.problem(
        "quadtree",
        fmt::format(
            "'most' is {} cells with one group each, and 'pool' is {}: raise it, or set 'hand_out'",
            tree.most, config.pool));
  try {
    tree.cells = tree.density.empty() ? named_cells(table, tree.leaves)
                                      : divided_by(config, read_density(tree.density, tree.reach));
    const aoim::CellPartition made = cells_of(config);  // checks beyond single keys
  } catch (const std::exception& error) {
    table.problem("quadtree", fmt::format("'quadtree': {}", error.what()));
  }
}

/// Checks that the locales are consistent.
void lay_out(TomlReader& table, const AoimConfig& config) {
  const std::size_t most = config.hand_out ? aoim::kMaximumPool : config.pool;
  if (config.locales.size() > most)
    return table.problem(
        "locale",
        fmt::format("{} locales need one group each, and 'pool' is {}: raise it, or set 'hand_out'",
                    config.locales.size(), config.pool));
  try {
    const aoim::CellPartition made = cells_of(config);
  } catch (const std::exception& error) {
    table.problem("locale", fmt::format("'locale': {}", error.what()));
  }
}

/// Whether the file has this scheme and its table; one without the other is a problem.
bool check_scheme(TomlReader& table, const AoimConfig& config, aoim::CellScheme scheme,
                  std::string_view key) {
  const bool is_it = config.scheme == scheme, has_table = table.has(key);
  if (is_it && !has_table)
    table.problem("scheme", fmt::format("'scheme' is \"{}\": describe it in {}", word_of(scheme),
                                        section_name(fmt::format("aoim.{}", key))));
  if (!is_it && has_table)
    table.problem(key, fmt::format("'{}' applies to one scheme only: write scheme = \"{}\"", key,
                                   word_of(scheme)));
  return is_it && has_table;
}

}  // namespace

std::vector<Row<AoimConfig>> cell_rows() {
  return {
      {"quadtree", &AoimConfig::quad_tree, quad_tree_section(),
       "with scheme = \"quadtree\": a square that is divided in crowds; the same for all peers"},
      {"locale", &AoimConfig::locales, locale_section(),
       "with scheme = \"locales\": a piece of the world, such as a room; peers receive entities "
       "within `radius` in it or in locales connected to it by neighbours; the same for all peers"},
  };
}

void check_cells(TomlReader& table, AoimConfig& config) {
  const bool is_tree = check_scheme(table, config, aoim::CellScheme::quad_tree, "quadtree");
  const bool is_map = check_scheme(table, config, aoim::CellScheme::locales, "locale");
  if (!is_tree && !is_map) return;
  if (table.has("cell"))
    table.problem("cell", "'cell' is the size of equal cells: remove it, or use another 'scheme'");
  if (is_tree && aoim::is_pool(config.pool)) divide(table, config);
  if (is_map) lay_out(table, config);
}

}  // namespace reckon::peer
