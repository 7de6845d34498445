// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Times and bounds that leaders and members must share.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim {

/// In place of a cell: the whole scene, whose leader assigns the groups.
inline constexpr CellId kWholeScene{std::numeric_limits<std::int32_t>::min(),
                                    std::numeric_limits<std::int32_t>::min()};

/// Tunables of leadership, with their defaults.
struct LeaderConfig {
  bool on = false;  ///< whether cells have leaders
  /// Whether states are sent to the groups that the leader of the scene assigns to cells; else each
  /// cell has the group that CellPartition computes for it.
  bool hand_out = false;
  /// Period of a leader's claim. When `missed` claims in a row have not come, its successor leads.
  std::chrono::nanoseconds heartbeat = std::chrono::milliseconds(500);
  std::int64_t missed = 3;  ///< claims, as above
  /// Period of a member's role; a member counts as gone after 3.5 of these.
  std::chrono::nanoseconds member_beat = std::chrono::milliseconds(1000);
  /// Time for which a newcomer listens for a leader before it leads itself.
  std::chrono::nanoseconds listen = std::chrono::milliseconds(1600);
  /// Each candidate waits this much longer than the candidate before it.
  std::chrono::nanoseconds stagger = std::chrono::milliseconds(200);
  /// Most cells in which one peer takes part; it does not take part in further ones.
  std::size_t most_cells = 128;
  /// Most peers remembered of one cell.
  std::size_t most_members = 256;

  /// Groups that may be assigned, up to 1,000; 0: as many as the grid has.
  std::size_t pool = 0;
  /// Time before a group without a cell is assigned again, > lease.
  std::chrono::nanoseconds quarantine = std::chrono::seconds(30);
  /// A peer that has received no map for this time uses none of its groups.
  std::chrono::nanoseconds lease = std::chrono::seconds(10);
  /// Period at which the map is repeated.
  std::chrono::nanoseconds refresh = std::chrono::seconds(2);
  /// A group that is new in the map is used for sending after this time, > refresh. By then all
  /// listeners have the map, even if one sending of it was lost.
  std::chrono::nanoseconds settle = std::chrono::milliseconds(2500);
  /// A cell that was empty for this time gives its group back.
  std::chrono::nanoseconds empty = std::chrono::seconds(5);

  /// Gap between two parts of a snapshot: 2,000 datagrams a second.
  std::chrono::nanoseconds part_gap = std::chrono::microseconds(500);
  /// Newcomers whose requests come within this time share a snapshot. A join takes as long.
  std::chrono::nanoseconds collect = std::chrono::milliseconds(30);
  /// Gap before a request is repeated.
  std::chrono::nanoseconds ask_again = std::chrono::milliseconds(200);
  /// A newcomer that still has no snapshot after this time asks the owners of the entities.
  std::chrono::nanoseconds give_up = std::chrono::milliseconds(1000);
};

}  // namespace reckon::aoim
