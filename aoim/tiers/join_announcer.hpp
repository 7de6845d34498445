// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Announces which cells this peer has joined, so that owners introduce the entities in them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/groups/control_stamp.hpp"
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/join_asks.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"

namespace reckon::aoim {

/// Cell Memberships that are to be sent. One thread; allocates as more cells are pending than ever
/// before.
class JoinAnnouncer {
 public:
  /// Gets each encoded PDU, for the base group; the octets are good during the call.
  using Send = std::function<void(std::span<const std::byte>)>;

  /// @param cells groups of the cells' tier
  JoinAnnouncer(const TierTable& tiers, std::size_t cells);

  /// Cells of the cells' tier, which are asked about until somebody answers; see JoinAsks.
  [[nodiscard]] JoinAsks& asks() noexcept { return asks_; }
  /// To be asked once: the owners of what is in this cell, for what they send to the tier.
  void ask_once(std::size_t tier, CellId cell);
  /// Whether something waits to be sent with the next step.
  [[nodiscard]] bool is_pending() const noexcept;

  /// Sends what is asked for the first time.
  void step(std::chrono::nanoseconds now, const ControlStamp& stamp, const Send& send);
  /// Sends what has to be asked again, beside an announcement of this peer.
  void repeat(std::chrono::nanoseconds now, const ControlStamp& stamp, const Send& send);

 private:
  void send_asks(bool announcing, std::chrono::nanoseconds now, const ControlStamp& stamp,
                 const Send& send);
  void send_once(std::size_t tier, const ControlStamp& stamp, const Send& send);

  TierTable tiers_;
  JoinAsks asks_;
  std::vector<std::vector<std::byte>> once_;  ///< encoded CellIndex of ask_once, by tier
};

}  // namespace reckon::aoim
