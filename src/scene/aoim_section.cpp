// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [aoim]: cells, groups and who hands them out, and what of it cannot be had with the rest of a
// file.
#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/peer/scene/beacon_names.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

void check_aoim(TomlReader& table, AoimConfig& config) {
  check_awareness(table, config.awareness);
  check_cells(table, config);
  try {
    static_cast<void>(beacon_names(config.follow));
  } catch (const std::invalid_argument& error) {
    table.problem("follow", fmt::format("'follow': {}", error.what()));
  }
  if (aoim::is_pool(config.pool)) return;
  table.problem("pool", fmt::format("'pool' is {}: {}", config.pool, aoim::kPoolRemedy));
}

/// What leaders cannot be had with.
void check_leaders(TomlReader& file, const SceneFile& scene) {
  if (scene.aoim.hand_out && !scene.aoim.leaders)
    file.problem("aoim", "'hand_out' wants somebody who hands out: set 'leaders', or take it out");
  if (!scene.aoim.follow.empty() && !scene.aoim.hand_out) {
    file.problem("aoim",
                 "'follow' finds beacons in the map of groups that are handed out: set 'leaders' "
                 "and 'hand_out', or take it out");
  }
  if (!scene.aoim.leaders) return;
  if (scene.network.interop)
    file.problem("aoim",
                 "'leaders' of cells say what 'interop' wants unsaid: take one of them out");
  if (scene.network.compression != pdu::CompressedForm::none) {
    file.problem(
        "aoim",
        "'leaders' tell late comers plain states, which 'compression' leaves out: take one "
        "of them out");
  }
  if (scene.aoim.awareness.channels) {
    file.problem("aoim",
                 "'leaders' tell late comers the last state heard, which 'channels' may have left "
                 "parts out of: take one of them out");
  }
}

/// What groups for what is felt and for near rows of the channels cannot be had with.
void check_more_groups(TomlReader& file, const SceneFile& scene) {
  const AoimConfig& aoim = scene.aoim;
  const std::string_view which = aoim.contact_groups ? "contact_groups" : "near_groups";
  const auto refuse = [&](std::string_view what) {
    file.problem("aoim", fmt::format("'{}' {}", which, what));
  };
  if (!aoim.contact_groups && !aoim.near_groups) return;
  if (scene.network.interop)
    refuse("are more than the one group of 'interop': take one of them out");
  if (aoim.hand_out) refuse("are those of the fixed tile, 'hand_out' has none: take one out");
  const std::size_t most = aoim::kMaximumPool / (aoim.all_groups() / aoim.pool);
  if (aoim.pool == 1)
    refuse(fmt::format("are told apart by cells, and a 'pool' of 1 has none: take 4 to {}", most));
  if (aoim.pool > most)
    refuse(fmt::format("are as many again as the 'pool': take one of 4 to {}", most));
}

/// What near groups want of the channels.
void check_near_groups(TomlReader& file, const SceneFile& scene) {
  const AoimConfig& aoim = scene.aoim;
  const auto refuse = [&](const char* what) { file.problem("aoim", what); };
  if (!aoim.near_groups) return;
  if (!aoim.awareness.channels)
    return refuse("'near_groups' are of use with 'channels' alone: set it, too");
  const aoim::ChannelTable table(aoim.awareness.table());
  if (table.near_rows() == 0)
    return refuse("'near_groups' want a row of 'channel' that is not 'kept', before the last");
  if (scene.network.compression == pdu::CompressedForm::residual)
    refuse(
        "'near_groups' are heard by some alone, and the residual form leans on what all have "
        "heard: take another 'compression'");
  if (table.channel(table.kept_rows()).coarser > 1.0)
    refuse("'near_groups' want thresholds of the scene in the nearest row: a 'coarser' of 1");
}

/// Walls are heard by groups.
void check_locales(TomlReader& file, const SceneFile& scene) {
  if (scene.network.interop && scene.aoim.scheme == aoim::CellScheme::locales)
    file.problem("aoim",
                 "'locales' are told apart by groups, and 'interop' has one: take one of them out");
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
           "of the pool, joined at once at most; what is beyond is not heard, and told"},
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
          {"contact_groups", &AoimConfig::contact_groups,
           "what is felt goes by a second group of its cell, which those alone listen to who can "
           "touch there, and which is read first; the same for all peers"},
          {"near_groups", &AoimConfig::near_groups,
           "with `channels`: each row but the last and those that are kept is said by a group of "
           "its own of each cell, which those alone listen to who are so near; the same for all "
           "peers"},
      },
      check_aoim};
  for (const auto& rows : {cell_rows(), awareness_rows()})
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  return section;
}

void check_aoim_of(TomlReader& file, const SceneFile& scene) {
  check_leaders(file, scene);
  check_more_groups(file, scene);
  check_near_groups(file, scene);
  check_locales(file, scene);
}

}  // namespace reckon::peer
