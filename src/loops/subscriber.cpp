// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/subscriber.hpp"

#include <utility>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

Subscriber::Subscriber(const ModelWiring& wiring, aoim::AreaOfInterestManager& aoim,
                       OwnedEntities& owned, RemoteEntities& remote)
    : scene_(wiring.scene),
      pool_(wiring.pool),
      commands_(wiring.commands),
      aoim_(aoim),
      owned_(owned),
      remote_(remote),
      cover_(cells_of(wiring.scene.aoim)),
      tier_foci_(tier_foci(wiring.scene)),
      aoim_watch_(wiring.scene, wiring.counters),
      leader_watch_(wiring.counters, wiring.scene.aoim.leaders),
      beacon_watch_(wiring.scene.aoim.follow) {}

void Subscriber::cover_our_entities() noexcept {
  balls_.clear();
  owned_.for_each([&](const OwnedEntity& entity, EntityNumber) {
    if (!entity.is_ours()) return;
    const EntityTruth& truth = entity.truth();
    balls_.push_back(
        {to_position(truth.position), truth.velocity.norm(), scene_.aoim.radius, cut_});
  });
  // A peer without entities uses the scene's origin.
  if (balls_.empty()) balls_.push_back({{}, 0.0, scene_.aoim.radius, cut_});
  foci_ = cover_.cover(balls_);
  moved_ = false;
}

// Publishes our beacons' positions, so that followers find their cells.
void Subscriber::place_beacons(nanoseconds now) noexcept {
  beacons_.clear();
  beacon_watch_.for_each_carried([this](EntityNumber number, std::uint32_t tag) {
    const OwnedEntity* entity = owned_.find(number);
    if (entity != nullptr) beacons_.push_back({tag, to_position(entity->truth().position)});
  });
  if (aoim::Leading* leading = aoim_.leading()) leading->set_beacons(beacons_, now);
}

void Subscriber::subscribe(nanoseconds now, std::span<const NearBodies> in_reach,
                           haptics::SpscRing<Notice>& notices) noexcept {
  if (moved_ && scene_.aoim.hand_out) place_beacons(now);
  const bool cut = std::exchange(cut_, aoim_.sight().cut()) != cut_;
  if (moved_ || cut) cover_our_entities();
  const FociInputs inputs{owned_, foci_, in_reach, now};
  for (std::size_t tier = 0; tier < aoim_.tiers().count(); ++tier) {
    const aoim::SubscriptionChange change = aoim_.listen(tier, tier_foci_[tier](inputs), now);
    command(change);
    remote_.leave_groups(change.leave, now);
    if (tier == aoim::kCellTier) aoim_watch_.look(aoim_, change, now, notices);
  }
  leader_watch_.look(aoim_, now, notices);
  beacon_watch_.look(aoim_, now, notices, leader_watch_.view());
}

void Subscriber::command(const aoim::SubscriptionChange& change) noexcept {
  const auto each = [&](std::span<const aoim::GroupIndex> groups, bool join) {
    for (const aoim::GroupIndex group : groups) {
      if (group == aoim::kBaseGroup) continue;
      static_cast<void>(commands_.push({pool_.address(group.value - 1u), join}));
    }
  };
  each(change.join, true);
  each(change.leave, false);
}

}  // namespace reckon::peer
