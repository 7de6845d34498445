// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tiers by distance ([[aoim.tier]]): the receivers of this peer's updates, and the budget of the
// peer itself.
#pragma once

#include <chrono>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"
#include "reckon/peer/scene/peer_config.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Keeps the positions of receivers, and the budget. One thread; allocates when more entities are
/// received than ever before; 0.1 us for each received entity, ten times a second. Does nothing
/// without such tiers.
class ChannelKeeper {
 public:
  /// @param config outlives this
  explicit ChannelKeeper(const AwarenessConfig& config) : config_(config) {}

  /// Call it some twenty times a second, after the foci were set. Begin and end of a shortage are
  /// reported to `out`.
  void look(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
            std::chrono::nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr Nanoseconds kPlaces = std::chrono::milliseconds(100);
  static constexpr Nanoseconds kBudget = std::chrono::seconds(1);

  void note_places(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                   Nanoseconds now) const;
  void keep_to_budget(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                      Nanoseconds now, haptics::SpscRing<Notice>& out);

  const AwarenessConfig& config_;
  Nanoseconds next_places_ = Nanoseconds::min(), next_budget_ = Nanoseconds::min();
  std::vector<aoim::ChannelClient> clients_;
  NoticeCondition stretched_;
};

}  // namespace reckon::peer
