// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The budget of a peer ([aoim] budget): the octets per second that it accepts.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/aoim/interest/reach_limit.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Enforces the budget in two ways. With tiers by distance it requests less from owners, by
/// reporting greater distances; they comply unless another receiver needs more. If the received
/// rate is still too high it leaves cells, the most distant first, but never cells of our own
/// entities or within reach of hands. One thread; allocates when more entities are received than
/// ever before.
class BudgetKeeper {
 public:
  /// @param scene with a budget
  explicit BudgetKeeper(const SceneFile& scene);

  /// Counts a received datagram.
  void note_heard(std::size_t octets) noexcept { heard_ += octets; }
  /// Call it some twenty times a second. Reports to `out` the effect of the budget, and whether it
  /// cannot be met.
  void look(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
            std::chrono::nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  void ask_for_less(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                    Nanoseconds now, haptics::SpscRing<Notice>& out);
  void report_reach(Nanoseconds now, haptics::SpscRing<Notice>& out);

  double budget_;  // [B/s]
  std::uint64_t heard_ = 0;
  aoim::ReachLimit limit_;
  Nanoseconds next_ask_ = Nanoseconds::min();
  std::vector<aoim::ChannelClient> clients_;
  double most_heard_ = 0.0;  // [B/s], since the rate last met the budget
  NoticeCondition stretched_, cut_, unmet_;
};

}  // namespace reckon::peer
