// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user when beacons that this peer follows or has are found, move, are lost, or
// belong to another peer.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::peer {

/// One thread; allocates at set-up, and when entities with beacons are new.
class BeaconWatch {
 public:
  /// A beacon of ours that the map shows in another cell for this long is reported as another
  /// peer's.
  static constexpr std::chrono::nanoseconds kDisputed = std::chrono::seconds(3);

  /// @param follow names, as for beacon_names
  explicit BeaconWatch(std::string_view follow);

  /// Adds the beacon of an entity of ours.
  void add(EntityNumber number, std::string_view name);
  void remove(EntityNumber number) noexcept;
  /// Calls visit(EntityNumber, tag) for each of ours.
  void for_each_carried(auto&& visit) const {
    for (const Carried& one : carried_) visit(one.number, one.tag);
  }
  [[nodiscard]] bool carries() const noexcept { return !carried_.empty(); }

  /// Call it some twenty times a second. Notices are added to `out`, followed beacons to `view`.
  void look(const aoim::AreaOfInterestManager& aoim, std::chrono::nanoseconds now,
            haptics::SpscRing<Notice>& out, LeadersView& view) noexcept;

 private:
  struct Followed {
    std::string name;
    bool reported = false;  ///< as found
    aoim::CellId cell;      ///< reported cell
  };
  struct Carried {
    EntityNumber number;
    std::uint32_t tag;
    std::string name;
    std::chrono::nanoseconds ours{};  ///< last time that the map had it in our cell, or had none
    bool reported = false;            ///< as another peer's
  };
  void report_followed(const aoim::FollowedBeacon& now, Followed& before,
                       haptics::SpscRing<Notice>& out) noexcept;
  void look_at_ours(const aoim::AreaOfInterestManager& aoim, std::chrono::nanoseconds now,
                    haptics::SpscRing<Notice>& out) noexcept;

  std::vector<Followed> followed_;  ///< as in the manager
  std::vector<Carried> carried_;
};

}  // namespace reckon::peer
