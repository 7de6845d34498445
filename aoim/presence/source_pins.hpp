// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Binds each peer to its source address, and distinguishes a peer that has moved from an impostor.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

/// Moves and impostors. The rows of the peers hold the pending ones. One thread; allocates nothing.
///
/// A peer moves when a revealed key proves its address (address_proof.hpp). A peer whose hand we
/// touch moves before that, provisionally, if its old address falls silent. The move is undone if
/// the old address sends again, or if the key refutes the new one.
class SourcePins {
 public:
  /// @param config, events outlive this
  SourcePins(const PresenceConfig& config, PresenceEvents& events) noexcept
      : config_(config), events_(events) {}

  /// Whether an announcement from this source is the peer's without a proof of its address.
  [[nodiscard]] static bool is_home(const Peer& peer, const SourceAddress& from) noexcept {
    return may_speak(peer.source, from) && peer.held.port == 0;
  }
  /// Notes the sender of an announcement: if it is the old address of a peer that moved on
  /// approval, the peer moves back.
  void note_sender(Peer& peer, const SourceAddress& from) {
    if (peer.held.port != 0 && from == peer.held) move_back(peer);
  }
  /// A link that opens the last commitment was revealed from any source: the peer is alive, and may
  /// move.
  void disclose(Peer& peer, const pdu::Presence& heard, std::chrono::nanoseconds now);
  /// Notes an announcement with such a link from this source.
  void note_proof(Peer& peer, const pdu::Presence& heard, std::chrono::nanoseconds now,
                  const SourceAddress& from);
  /// Whether an acceptable announcement from another source moves the peer at once. Only a peer
  /// that has proved no address, or is sealed, may move so, after a long silence.
  [[nodiscard]] bool may_move(const Peer& peer, const pdu::Presence& heard,
                              std::chrono::nanoseconds now, const SourceAddress& from) const;
  /// The source of the peer is `to` from now on.
  void move(Peer& peer, const SourceAddress& to);

  /// Notes a datagram with the peer's epoch from another source. If it is the old address of a peer
  /// that moved on approval, the peer moves back. If the peer can prove its address, an impostor is
  /// reported when a key refutes it, or when the peer is received after half a second and the
  /// other source has proved nothing for 2.5 s (10 s if the peer has proved nothing either).
  void note_impostor(Peer& peer, const SourceAddress& from, std::chrono::nanoseconds now);
  /// Counts a refused announcement or list of an impostor.
  void refuse(Peer& peer, const SourceAddress& from, std::chrono::nanoseconds now);
  /// The same for an impostor of a claimant of an ID; it is only counted.
  void refuse() noexcept { ++refused_; }

  /// Whether a pending move or impostor is due, so that all peers must be checked.
  [[nodiscard]] bool begin_settling(std::chrono::nanoseconds now) noexcept;
  /// Checks a peer: reports an impostor that is due, and moves the peer on approval or back.
  void settle(Peer& peer, std::chrono::nanoseconds now);
  /// When a pending move or impostor is due; nanoseconds::max() if none is.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept { return next_; }

  /// Announcements and lists refused so far.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  void settle_suspect(Peer& peer, std::chrono::nanoseconds now);
  void move_on_approval(Peer& peer, std::chrono::nanoseconds now);
  void move_back(Peer& peer);
  void report_impostor(Peer& peer, SourceAddress from);

  const PresenceConfig& config_;
  PresenceEvents& events_;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::max();
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
