// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Each peer is pinned to the source that it speaks from. Here a peer that has moved is
// distinguished from one that only speaks in its name.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

/// Moves and impostors, of which the rows of the peers keep what is pending. One thread; allocates
/// nothing.
class SourcePins {
 public:
  /// @param config, events outlive this
  SourcePins(const PresenceConfig& config, PresenceEvents& events) noexcept
      : config_(config), events_(events) {}

  /// Whether a believable announcement from elsewhere moves the peer at once. One that offers a
  /// proof waits until its former source is known to be silent, see settle().
  [[nodiscard]] bool may_move(Peer& peer, const pdu::Presence& heard, std::chrono::nanoseconds now,
                              const SourceAddress& from);
  /// The peer speaks from `to` from now on.
  void move(Peer& peer, const SourceAddress& to);

  /// A datagram in the name of the peer came from elsewhere. Of one that can prove itself it is
  /// reported when it has not done so half a second later.
  void note_impostor(Peer& peer, const SourceAddress& from, std::chrono::nanoseconds now);
  /// An announcement or list of such a one is refused, and counted.
  void refuse(Peer& peer, const SourceAddress& from, std::chrono::nanoseconds now);
  /// The same where the claimant of an id was spoken for: counted only.
  void refuse() noexcept { ++refused_; }

  /// Whether something is to be settled now: each peer is to be looked at then.
  [[nodiscard]] bool begin_settling(std::chrono::nanoseconds now) noexcept;
  /// Reports an impostor whose time is over. @return the move of the peer, if it has moved
  [[nodiscard]] std::optional<Move> settle(Peer& peer, std::chrono::nanoseconds now);
  /// When something is to be settled; duration max where nothing is.
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
