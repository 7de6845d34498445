// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Times and bounds that all who lead or are led must agree on.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim {

/// Stands for the scene as a whole: who leads it hands out the groups.
inline constexpr CellId kWholeScene{std::numeric_limits<std::int32_t>::min(),
                                    std::numeric_limits<std::int32_t>::min()};

/// Tunables of leadership; defaults are those of the field.
struct LeaderConfig {
  bool on = false;  ///< whether cells have leaders at all
  /// Whether states go by the groups that who leads the scene hands out; else by the fixed tile.
  bool hand_out = false;
  /// A leader says so every 0.5 s; after three that are missed its successor leads.
  std::chrono::nanoseconds heartbeat = std::chrono::milliseconds(500);
  std::int64_t missed = 3;
  /// Who does not lead says where it is every second; after 3.5 of these it counts as gone.
  std::chrono::nanoseconds member_beat = std::chrono::milliseconds(1000);
  /// A newcomer listens for a leader for so long before it leads itself.
  std::chrono::nanoseconds listen = std::chrono::milliseconds(1600);
  /// Of those who could lead, each waits so much longer than the one before it.
  std::chrono::nanoseconds stagger = std::chrono::milliseconds(200);
  /// Cells in which one peer takes part at most; in further ones it has no say.
  std::size_t most_cells = 128;
  /// Peers remembered of one cell.
  std::size_t most_members = 256;

  /// Groups that may be handed out, up to 1,000; 0: as many as the grid has.
  std::size_t pool = 0;
  /// A group that no cell has any more is given to another one after so long, > lease.
  std::chrono::nanoseconds quarantine = std::chrono::seconds(30);
  /// Who has not heard the map for so long uses none of its groups.
  std::chrono::nanoseconds lease = std::chrono::seconds(10);
  /// The map is said again after so long.
  std::chrono::nanoseconds refresh = std::chrono::seconds(2);
  /// A group that is new in the map is used for sending after so long, > refresh: whoever listens
  /// has heard the map by then, though one telling of it was lost.
  std::chrono::nanoseconds settle = std::chrono::milliseconds(2500);
  /// A cell in which nobody has been for so long gives its group back.
  std::chrono::nanoseconds empty = std::chrono::seconds(5);

  /// Between two parts of a snapshot: 2,000 datagrams a second.
  std::chrono::nanoseconds part_gap = std::chrono::microseconds(500);
  /// Newcomers that ask within this share a snapshot; their joins need it too.
  std::chrono::nanoseconds collect = std::chrono::milliseconds(30);
  /// Who lacks something asks again after so long.
  std::chrono::nanoseconds ask_again = std::chrono::milliseconds(200);
  /// Who has not got its snapshot by then asks the owners themselves.
  std::chrono::nanoseconds give_up = std::chrono::milliseconds(1000);
};

}  // namespace reckon::aoim
