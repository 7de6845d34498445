// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who leads the scene and the cells that this peer is in, reported to the user when it changes.
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

/// Looks at the leaders of one manager. One thread; allocates where cells are new.
class LeaderWatch {
 public:
  /// Changes of cells within this are one sentence for each leader.
  static constexpr std::chrono::nanoseconds kGather = std::chrono::milliseconds(500);

  /// Makes the counters leader_changes, cells_led, group_map_version, states_relayed_in and
  /// snapshot_parts_out, where `on`. `counters` outlives it.
  LeaderWatch(Counters& counters, bool on);

  /// Call it some twenty times a second. Sentences go to `out`.
  void look(const aoim::AreaOfInterestManager& aoim, std::chrono::nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;
  /// A leader has relayed a state to us.
  void note_relayed() noexcept {
    if (relayed_in_ != nullptr) relayed_in_->add();
  }
  /// As of the last look; what is followed is filled in by BeaconWatch.
  [[nodiscard]] LeadersView& view() noexcept { return view_; }
  [[nodiscard]] const LeadersView& view() const noexcept { return view_; }

 private:
  /// A cell of ours: who leads it, and who was last reported to the user.
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
  std::chrono::nanoseconds tell_at_{-1};  ///< changes of cells; negative: there are none
  Counter* changes_ = nullptr;
  Counter* led_ = nullptr;
  Counter* map_version_ = nullptr;
  Counter* relayed_in_ = nullptr;
  Counter* parts_out_ = nullptr;
};

}  // namespace reckon::peer
