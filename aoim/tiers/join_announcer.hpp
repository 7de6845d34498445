// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Announces the cells that this peer has joined, so that owners introduce their entities there.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/groups/control_stamp.hpp"
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/join_asks.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"

namespace reckon::aoim {

/// The tier in whose cells a peer begins to listen; std::nullopt: it does not begin, or the scene
/// lacks the tier.
[[nodiscard]] std::optional<std::size_t> joined_tier(const pdu::CellMembership& membership,
                                                     const TierTable& tiers) noexcept;

/// Pending Cell Membership PDUs. One thread; allocates when more cells are pending than ever
/// before.
class JoinAnnouncer {
 public:
  /// Receives each encoded PDU, for the base group; the octets are valid during the call.
  using Send = std::function<void(std::span<const std::byte>)>;

  /// @param cells groups of the cell tier
  JoinAnnouncer(const TierTable& tiers, std::size_t cells);

  /// Cells of the cell tier, which are requested until an owner answers; see JoinAsks.
  [[nodiscard]] JoinAsks& asks() noexcept { return asks_; }
  /// Requests once the introduction for this tier from the owners of the entities in this cell.
  void ask_once(std::size_t tier, CellId cell);
  /// Whether the next step has anything to send.
  [[nodiscard]] bool is_pending() const noexcept;

  /// Sends the first requests.
  void step(std::chrono::nanoseconds now, const ControlStamp& stamp, const Send& send);
  /// Repeats pending requests, beside an announcement of this peer.
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
