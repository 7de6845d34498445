// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports changes of the leaders of the scene and of this peer's cells to the user.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::peer {

/// Watches the leaders of one manager. One thread; allocates when cells are new.
class LeaderWatch {
 public:
  /// Changes of cells within this time are reported in one sentence for each leader.
  static constexpr std::chrono::nanoseconds kGather = std::chrono::milliseconds(500);

  /// Makes the counters leader_changes, cells_led, group_map_version, states_relayed_in and
  /// snapshot_parts_out if `on`. `counters` outlives it.
  LeaderWatch(Counters& counters, bool on);

  /// Call it some twenty times a second. Notices are added to `out`.
  void look(const aoim::AreaOfInterestManager& aoim, std::chrono::nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;
  /// Records a state that a leader relayed to us.
  void note_relayed() noexcept {
    if (relayed_in_ != nullptr) relayed_in_->add();
  }
  /// As of the last look; BeaconWatch fills in the followed beacons.
  [[nodiscard]] LeadersView& view() noexcept { return view_; }
  [[nodiscard]] const LeadersView& view() const noexcept { return view_; }

 private:
  /// A cell of ours: its leader, and the leader last reported to the user.
  struct Cell {
    aoim::CellId id;
    std::uint32_t leader = 0, reported = 0;
    bool present = false;
  };
  void note_cell(const aoim::AreaOfInterestManager& aoim, aoim::CellId id, std::uint32_t leader);
  void report_cells(const aoim::AreaOfInterestManager& aoim, std::uint32_t leader,
                    haptics::SpscRing<Notice>& out) noexcept;

  LeadersView view_;
  std::vector<Cell> cells_;
  std::chrono::nanoseconds tell_at_{-1};  ///< when to report changes; negative: there are none
  Counter* changes_ = nullptr;
  Counter* led_ = nullptr;
  Counter* map_version_ = nullptr;
  Counter* relayed_in_ = nullptr;
  Counter* parts_out_ = nullptr;
};

}  // namespace reckon::peer
