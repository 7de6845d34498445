// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/scenery/drawn_groups.hpp"

#include <fmt/format.h>

#include <vector>

#include "reckon/aoim/leader/beacon_book.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/beacon_names.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

aoim::Position position_of(const EntityMark& mark) {
  return {mark.position.x(), mark.position.y(), mark.position.z()};
}

void append_group(std::string& out, const SharedGroup& shared) {
  JsonObject(out)
      .text("tier", shared.group.tier == GroupTier::contact ? "contact" : "near")
      .value("group", shared.group.number)
      .array("slots", shared.slots,
             [](std::string& slots, std::uint16_t slot) { slots += std::to_string(slot); })
      .end();
}

}  // namespace

DrawnGroups::DrawnGroups(const peer::SceneFile& scene) : cells_(peer::cells_of(scene.aoim)) {
  for (const peer::EntityConfig& entity : scene.entities)
    if (!entity.beacon.empty()) names_.emplace(aoim::beacon_tag(entity.beacon), entity.beacon);
  for (const std::string& name : peer::beacon_names(scene.aoim.follow))
    names_.emplace(aoim::beacon_tag(name), name);
}

bool DrawnGroups::has_any(const peer::SceneFile& scene) noexcept {
  if (scene.network.interop) return false;
  return scene.aoim.hand_out || scene.aoim.all_groups() > scene.aoim.pool;
}

std::string DrawnGroups::name_of(std::uint32_t tag) const {
  const auto known = names_.find(tag);
  return known == names_.end() ? fmt::format("beacon {:08x}", tag) : known->second;
}

std::optional<aoim::Position> DrawnGroups::place_of(const ReceivedBeacon& beacon,
                                                    const Roster& roster,
                                                    std::span<const EntityMark> marks) const {
  const aoim::GroupIndex number = cells_.group(aoim::CellId{beacon.cell.column, beacon.cell.row});
  for (const EntityMark& mark : marks) {
    const auto id = roster.id_at(mark.slot);
    if (!id || id->simulation() != beacon.owner || !mark.position.allFinite()) continue;
    const aoim::CellId cell = cells_.cell(position_of(mark));
    if (cells_.group(cell) == number)
      return cells_.visit([&](const auto& scheme) { return scheme.centre(cell); });
  }
  return std::nullopt;
}

std::string DrawnGroups::message(const ReceivedGroups& received, const Roster& roster,
                                 std::span<const EntityMark> marks, nanoseconds time,
                                 nanoseconds start) const {
  struct Placed {
    std::uint32_t tag;
    const ReceivedBeacon& beacon;
    aoim::Position centre;
  };
  std::vector<Placed> beacons;
  for (const auto& [tag, beacon] : received.beacons()) {
    if (time - beacon.received > ReceivedGroups::kBeaconKept) continue;
    if (const auto centre = place_of(beacon, roster, marks))
      beacons.push_back({tag, beacon, *centre});
  }
  std::string out;
  JsonObject(out)
      .text("type", "groups")
      .array("groups", received.shared_at(time), append_group)
      .array("beacons", beacons,
             [&](std::string& text, const Placed& one) {
               const pdu::SimulationAddress& owner = one.beacon.owner;
               JsonObject(text)
                   .text("name", name_of(one.tag))
                   .text("peer", fmt::format("{}:{}", owner.site, owner.application))
                   .decimals("x", one.centre.x, 3)
                   .decimals("y", one.centre.y, 3)
                   .decimals("heard", pdu::to_seconds(one.beacon.received - start), 3)
                   .end();
             })
      .end();
  return out;
}

}  // namespace reckon::tools
