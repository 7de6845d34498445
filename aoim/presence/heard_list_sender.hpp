// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Our list of the peers whom we hear: when it leaves, and in how many parts.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"

namespace reckon::aoim {

/// Those whom we hear, or a part of them.
struct HeardList {
  std::span<const std::uint32_t> epochs;  ///< a part is in ascending order
  std::uint16_t continues = 0;            ///< pdu::kPeersHeardBelow, pdu::kPeersHeardAbove
};

/// Sends the list with each announcement that is more than a heartbeat; else once a heartbeat: when
/// we have been silent for three quarters of it, as a sign of life, or with an announcement. One
/// thread; allocates nothing after construction.
class HeardListSender {
 public:
  /// @param config, peers outlive this
  HeardListSender(const PresenceConfig& config, const PeerTable& peers);

  /// A list goes with the announcement that leaves now.
  void send_now(std::chrono::nanoseconds now) noexcept { next_ = now; }
  /// The list, where it is time to send it; good until the next call.
  /// @param last_sent when our last datagram left, whatever was in it
  /// @param announced when our last announcement left  @param announcing when the next one does
  [[nodiscard]] std::optional<HeardList> take(std::chrono::nanoseconds now,
                                              std::chrono::nanoseconds last_sent,
                                              std::optional<std::chrono::nanoseconds> announced,
                                              std::chrono::nanoseconds announcing);
  /// When take() may have one.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return next_; }

 private:
  [[nodiscard]] HeardList next_part();

  const PresenceConfig& config_;
  const PeerTable& peers_;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::max();
  std::vector<std::uint32_t> list_;
  std::uint32_t sent_to_ = 0;  // the last one of the last part
};

}  // namespace reckon::aoim
