// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [aoim]: cells, groups and who hands them out, and what of it cannot be had with the rest of a
// file.
#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "reckon/peer/scene/beacon_names.hpp"
#include "reckon/peer/scene/mechanisms.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

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

/// Groups of more tiers are as many again as those of the cells.
void check_pool(TomlReader& file, const SceneFile& scene) {
  const AoimConfig& aoim = scene.aoim;
  if (aoim.all_groups() == aoim.pool) return;
  const std::string_view which = has_touch_tier(aoim.tiers) ? "to = \"touch\"" : "own_group";
  const std::size_t most = aoim::kMaximumPool / (aoim.all_groups() / aoim.pool);
  if (aoim.pool == 1)
    file.problem_at("aoim.pool",
                    fmt::format("'{}' has a group for each cell, and a 'pool' of 1 has no cells: "
                                "take 4 to {}",
                                which, most));
  if (aoim.pool > most)
    file.problem_at(
        "aoim.pool",
        fmt::format("'{}' needs as many groups again as the 'pool': take one of 4 to {}", which,
                    most));
}

}  // namespace

Section<AoimConfig> aoim_section() {
  Section<AoimConfig> section{
      {
          {"scheme", &AoimConfig::scheme,
           "how space is cut into cells: equal squares or hexagons, a square that is divided where "
           "many are, or locales such as rooms"},
          {"cell", &AoimConfig::cell, within("m", 0.01, kWorld),
           "side of a square, corner radius of a hexagon"},
          {"radius", &AoimConfig::radius, within("m", 0.01, kWorld), "how far this peer senses"},
          {"pool", &AoimConfig::pool, within("", 1, aoim::kMaximumPool),
           "multicast groups after the base group; not 2 or 3"},
          {"groups", &AoimConfig::groups, within("", 1, aoim::kMaximumPool),
           "of the pool, joined at once at most; what is beyond is not received, and reported"},
          {"leaders", &AoimConfig::leaders,
           "each cell has a leader, who tells what is in it to those that come late; the same for "
           "all peers"},
          {"hand_out", &AoimConfig::hand_out,
           "with leaders: who leads the scene gives each cell in which somebody is a group of the "
           "pool, as long as there are some; else cells that lie a tile apart share one; the same "
           "for all peers"},
          {"follow", &AoimConfig::follow,
           "with `hand_out`: beacons of entities, as in \"gate, ferry\", whose cells are listened "
           "to "
           "and whose contents are shown, wherever they are"},
          {"tier", &AoimConfig::tiers, tier_section(),
           "who receives an update, how often and how well, inmost first: those who can touch the "
           "entity, then by distance; when absent, everything goes to all; the same for all "
           "peers"},
      },
      check_aoim};
  for (const auto& rows : {cell_rows(), awareness_rows()})
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  return section;
}

void check_aoim_of(TomlReader& file, const SceneFile& scene) {
  check_mechanisms(file, scene);
  check_pool(file, scene);
}

}  // namespace reckon::peer
