// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/scenery/received_bodies.hpp"

#include <cstdint>
#include <unordered_map>

#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::tools {

void place_received_bodies(std::span<const DrawnSolid> solids, const Roster& roster,
                           PictureRows& rows) {
  const bool is_listener = rows.bodies.empty();
  std::unordered_map<std::uint16_t, std::size_t> slots;  // of bodies
  for (const DrawnSolid& solid : solids) {
    if (!solid.body) continue;
    if (is_listener)
      rows.bodies.push_back({solid.pose.position.cast<float>(), solid.pose.orientation, true});
    const std::uint16_t slot = roster.slot_of(peer::body_id(*solid.body));
    if (slot != kNoNumber && *solid.body < rows.bodies.size() && rows.bodies[*solid.body].carried)
      slots[slot] = *solid.body;
  }
  if (is_listener && slots.empty()) return rows.bodies.clear();
  for (const EntityMark& entity : rows.entities) {
    const auto found = slots.find(entity.slot);
    if (found == slots.end()) continue;
    deadreckon::Pose pose;
    pose.position = entity.position + entity.error.cast<double>();
    pose.orientation = entity.orientation;
    const haptics::ObjectMotion motion = peer::motion_of(pose);
    rows.bodies[found->second] = {motion.position.cast<float>(), motion.orientation, true};
  }
}

}  // namespace reckon::tools
