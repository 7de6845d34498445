// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/loaded_scene.hpp"

#include <fmt/format.h>

#include <exception>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/scene/scene_extent.hpp"
#include "reckon/peer/tracks/hand_trace_file.hpp"
#include "reckon/tools/command_line/file_kind.hpp"
#include "reckon/tools/exercise/felt_device.hpp"

namespace reckon::tools {

using peer::format_quantity;

LoadedScene load_whole_scene(const std::string& path) {
  if (std::string remedy = no_scene_remedy(path); !remedy.empty())
    throw peer::SceneFileError(path, {{0, 0, std::move(remedy)}});
  LoadedScene scene{peer::load_scene_file(path), {}};
  try {
    scene.plan = haptics::EffectPlan(scene.file.scene);
    check_felt(scene.file, scene.plan);
    for (const peer::OperatorConfig& hand : scene.file.operators) {
      if (hand.kind == peer::OperatorKind::trace) (void)peer::read_hand_trace(hand.trace);
    }
  } catch (const std::exception& error) {
    throw peer::SceneFileError(path, {{0, 0, error.what()}});
  }
  return scene;
}

namespace {

// Reports that `touch` admits peers outside the scene.
std::string touch_note(const peer::NetworkConfig& network) {
  if (network.touch_rule().text() != "all" || !network.key.empty()) return {};
  std::string note = "every host on the LAN may press a hand ('touch' is all)";
  if (network.interop) note += ", and bodies of other programs are not felt";
  return note + ": list the allowed peers in 'touch'";
}

}  // namespace

std::vector<std::string> scene_notes(const peer::SceneFile& file) {
  const peer::GroupNeeds needs = peer::group_needs(file);
  std::vector<std::string> notes;
  if (needs.all() && !needs.capped()) {
    notes.push_back(
        fmt::format("the radius of {} needs all {} groups in use, so cells filter nothing: enlarge "
                    "the cells or the pool",
                    format_quantity(file.aoim.radius, "m"), needs.in_use));
  }
  if (needs.capped()) {
    notes.push_back(
        fmt::format("the radius of {} may need {} groups, but [aoim] groups is {}, so its farthest "
                    "part is not received: raise groups, or use cells larger than {}",
                    format_quantity(file.aoim.radius, "m"), needs.within_radius, needs.most_joined,
                    format_quantity(peer::cells_of(file.aoim).finest(), "m")));
  }
  if (std::string note = peer::unsensed_note(file); !note.empty()) notes.push_back(std::move(note));
  for (const peer::TierConfig& tier : file.aoim.tiers) {
    if (!tier.own_group || tier.channel.farthest < file.aoim.radius) continue;
    notes.push_back(fmt::format(
        "the tier up to {} reaches the radius of {}, so its own group saves nothing: make it the "
        "last one, without 'farthest'",
        format_quantity(tier.channel.farthest, "m"), format_quantity(file.aoim.radius, "m")));
    break;
  }
  if (std::string note = touch_note(file.network); !note.empty()) notes.push_back(std::move(note));
  return notes;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace reckon::tools
