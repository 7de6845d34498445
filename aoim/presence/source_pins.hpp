// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Binds each peer to its source address, and distinguishes a peer that has moved from an impostor.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

/// Moves and impostors. The rows of the peers hold the pending ones. One thread; allocates nothing.
class SourcePins {
 public:
  /// @param config, events outlive this
  SourcePins(const PresenceConfig& config, PresenceEvents& events) noexcept
      : config_(config), events_(events) {}

  /// Whether an acceptable announcement from another source moves the peer at once. One with a
  /// proof is pending until the former source is silent, see settle().
  [[nodiscard]] bool may_move(Peer& peer, const pdu::Presence& heard, std::chrono::nanoseconds now,
                              const SourceAddress& from);
  /// The source of the peer is `to` from now on.
  void move(Peer& peer, const SourceAddress& to);

  /// Notes a datagram with the peer's epoch from another source. If the peer can prove its
  /// identity, the impostor is reported after half a second without a proof.
  void note_impostor(Peer& peer, const SourceAddress& from, std::chrono::nanoseconds now);
  /// Counts a refused announcement or list of an impostor.
  void refuse(Peer& peer, const SourceAddress& from, std::chrono::nanoseconds now);
  /// The same for an impostor of a claimant of an ID; it is only counted.
  void refuse() noexcept { ++refused_; }

  /// Whether a pending move or impostor is due, so that all peers must be checked.
  [[nodiscard]] bool begin_settling(std::chrono::nanoseconds now) noexcept;
  /// Checks a peer; reports an impostor that is due. @return the move of the peer, if it has moved
  [[nodiscard]] std::optional<Move> settle(Peer& peer, std::chrono::nanoseconds now);
  /// When a pending move or impostor is due; nanoseconds::max() if none is.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return next_; }

  /// Announcements and lists refused so far.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  void report_impostor(Peer& peer, SourceAddress from);

  const PresenceConfig& config_;
  PresenceEvents& events_;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::max();
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
