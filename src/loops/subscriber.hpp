// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Subscribes to the groups of all recipient tiers around this peer's entities, and places its
// beacons.
#pragma once

#include <chrono>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/peer/loops/aoim_watch.hpp"
#include "reckon/peer/loops/beacon_watch.hpp"
#include "reckon/peer/loops/leader_watch.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/tier_foci.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// One thread; allocates at set-up, and when entities with beacons are new.
class Subscriber {
 public:
  /// References outlive this.
  Subscriber(const ModelWiring& wiring, aoim::AreaOfInterestManager& aoim, OwnedEntities& owned,
             RemoteEntities& remote);

  /// Records that an entity of ours was moved, added or removed.
  void note_moved() noexcept { moved_ = true; }
  /// Adds the beacon of an entity of ours.
  void add_beacon(EntityNumber number, std::string_view name) { beacon_watch_.add(number, name); }
  void remove_beacon(EntityNumber number) noexcept { beacon_watch_.remove(number); }

  /// Joins the base group, once, before all others.
  void join_base() noexcept { static_cast<void>(commands_.push({pool_.base(), true})); }
  /// Joins and leaves groups; call it some twenty times a second.
  /// @param in_reach bodies in reach of each of our hands  @param notices for the user
  void subscribe(std::chrono::nanoseconds now, std::span<const NearBodies> in_reach,
                 haptics::SpscRing<Notice>& notices) noexcept;

  /// Records a state that a leader relayed.
  void note_relayed() noexcept { leader_watch_.note_relayed(); }
  [[nodiscard]] const LeadersView& leaders() const noexcept { return leader_watch_.view(); }

 private:
  void cover_our_entities() noexcept;
  void place_beacons(std::chrono::nanoseconds now) noexcept;
  void command(const aoim::SubscriptionChange& change) noexcept;

  const SceneFile& scene_;
  const GroupPool& pool_;
  haptics::SpscRing<GroupCommand>& commands_;
  aoim::AreaOfInterestManager& aoim_;
  OwnedEntities& owned_;
  RemoteEntities& remote_;
  std::vector<aoim::Focus> balls_;  // ranges of our entities
  aoim::FocusCover cover_;
  std::span<const aoim::Focus> foci_;                     // they cover the balls
  double cut_ = std::numeric_limits<double>::infinity();  // [m], limit of the balls' radii
  bool moved_ = true;                                     // an entity of ours has moved since
  std::vector<TierFoci> tier_foci_;
  std::vector<aoim::PlacedBeacon> beacons_;  // last positions of our beacons
  AoimWatch aoim_watch_;
  LeaderWatch leader_watch_;
  BeaconWatch beacon_watch_;
};

}  // namespace reckon::peer
