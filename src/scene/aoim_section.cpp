// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [aoim]: cells, groups and their assignment, and conflicts with other parts of a file.
#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "reckon/peer/notation/beacon_names.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/settings/mechanisms.hpp"

namespace reckon::peer {
namespace {

void check_aoim(TomlReader& table, AoimConfig& config) {
  check_awareness(table, config.awareness);
  check_cells(table, config);
  check_tiers(table, config.tiers);
  try {
    static_cast<void>(beacon_names(config.follow));
  } catch (const std::invalid_argument& error) {
    table.problem("follow", fmt::format("'follow': {}", error.what()));
  }
  if (aoim::is_pool(config.pool)) return;
  table.problem("pool", fmt::format("'pool' is {}: {}", config.pool, aoim::kPoolRemedy));
}

/// Each further tier needs as many groups as the cells.
void check_pool(TomlReader& file, const SceneFile& scene) {
  const AoimConfig& aoim = scene.aoim;
  if (aoim.all_groups() == aoim.pool) return;
  const std::string_view which = has_touch_tier(aoim.tiers) ? "to = \"touch\"" : "own_group";
  const std::size_t most = aoim::kMaximumPool / (aoim.all_groups() / aoim.pool);
  if (aoim.pool == 1)
    file.problem_at(
        "aoim.pool",
        fmt::format(
            "'{}' needs a group for each cell, and a 'pool' of 1 has no cells: write 4 to {}",
            which, most));
  if (aoim.pool > most)
    file.problem_at(
        "aoim.pool",
        fmt::format("'{}' needs twice the groups of the 'pool': write 4 to {}", which, most));
}

}  // namespace

Section<AoimConfig> aoim_section() {
  Section<AoimConfig> section{
      {
          {"scheme", &AoimConfig::scheme,
           "cells of space: equal squares, equal hexagons, a quad-tree that is finer in crowds, or "
           "locales such as rooms"},
          {"cell", &AoimConfig::cell, within("m", 0.01, kWorld),
           "side of a square, corner radius of a hexagon; when absent in a scene with entities "
           "farther apart than 2 m, half of the power of ten that contains them"},
          {"radius", &AoimConfig::radius, within("m", 0.01, kWorld),
           "distance within which this peer receives entities; when absent in a scene with "
           "entities farther apart than 2 m, the power of ten that contains them"},
          {"pool", &AoimConfig::pool, within("", 1, aoim::kMaximumPool),
           "multicast groups after the base group; not 2 or 3"},
          {"groups", &AoimConfig::groups, within("", 1, aoim::kMaximumPool),
           "most groups of the pool that are joined at the same time; more are reported and not "
           "received"},
          {"leaders", &AoimConfig::leaders,
           "each cell has a leader that sends the states of its entities to newcomers; the same "
           "for all peers"},
          {"hand_out", &AoimConfig::hand_out,
           "with leaders: the leader of the scene assigns free groups of the pool to occupied "
           "cells; otherwise cells one tile apart share a group; the same for all peers"},
          {"follow", &AoimConfig::follow,
           "with `hand_out`: names of beacons, for example \"gate, ferry\"; this peer joins their "
           "cells, wherever they are, and shows the entities there"},
          {"tier", &AoimConfig::tiers, tier_section(),
           "recipient tiers, nearest first: which peers receive an update, how often and how "
           "accurately; when absent, all peers receive everything; the same for all peers"},
      },
      check_aoim};
  for (const auto& rows : {cell_rows(), awareness_rows()})
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  return section;
}

void check_aoim_of(TomlReader& file, const SceneFile& scene) {
  for (const UnmetCondition& unmet : unmet_conditions({scene.aoim, scene.network}))
    file.problem_at(unmet.path, unmet.sentence);
  check_pool(file, scene);
}

}  // namespace reckon::peer
