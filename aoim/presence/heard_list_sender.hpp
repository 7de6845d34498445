// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Our list of received peers (Peers Heard PDU): when it is sent, and in how many parts.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"

namespace reckon::aoim {

/// The received peers, or a part of them.
struct HeardList {
  std::span<const std::uint32_t> epochs;  ///< a part is in ascending order
  std::uint16_t continues = 0;            ///< pdu::kPeersHeardBelow, pdu::kPeersHeardAbove
};

/// Sends the list with each announcement that is more than a heartbeat, otherwise once a heartbeat.
/// If we send nothing for three quarters of a heartbeat the list is the sign of life; otherwise it
/// goes with an announcement. One thread; allocates nothing after construction.
class HeardListSender {
 public:
  /// @param config, peers outlive this
  HeardListSender(const PresenceConfig& config, const PeerTable& peers);

  /// Sends a list with the announcement that is sent now.
  void send_now(std::chrono::nanoseconds now) noexcept { next_ = now; }
  /// The list if it is due; valid until the next call.
  /// @param last_sent when our last datagram was sent, with any content
  /// @param announced when our last announcement was sent  @param announcing when the next one is
  /// due
  [[nodiscard]] std::optional<HeardList> take(std::chrono::nanoseconds now,
                                              std::chrono::nanoseconds last_sent,
                                              std::optional<std::chrono::nanoseconds> announced,
                                              std::chrono::nanoseconds announcing);
  /// When take() may return a list.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return next_; }

 private:
  [[nodiscard]] HeardList next_part();

  const PresenceConfig& config_;
  const PeerTable& peers_;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::max();
  std::vector<std::uint32_t> list_;
  std::uint32_t sent_to_ = 0;  // last epoch of the last part
};

}  // namespace reckon::aoim
