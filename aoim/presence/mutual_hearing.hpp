// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether we and the other peers receive each other, by their Peers Heard lists.
#pragma once

#include <chrono>

#include "reckon/aoim/presence/announcement_pace.hpp"
#include "reckon/aoim/presence/claims.hpp"
#include "reckon/aoim/presence/former_lives.hpp"
#include "reckon/aoim/presence/own_identity.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"

namespace reckon::aoim {

/// Reads the lists of others into their rows. One thread; allocates nothing.
class MutualHearing {
 public:
  /// All references must outlive this.
  MutualHearing(const PresenceConfig& config, const PeerTable& peers, const Claims& claims,
                const FormerLives& former, const OwnIdentity& own, const AnnouncementPace& pace,
                PresenceEvents& events) noexcept
      : config_(config),
        peers_(peers),
        claims_(claims),
        former_(former),
        own_(own),
        pace_(pace),
        events_(events) {}

  /// Reads the list of a claimant of an ID.
  void read(Claimant& claimant, const pdu::PeersHeard& list,
            std::chrono::nanoseconds now) const noexcept {
    read(claimant.hears, list, now);
  }
  /// Reads the list of a joined peer. Reports if it received us late, does not receive us, or
  /// receives us again.
  void read(Peer& peer, const pdu::PeersHeard& list, std::chrono::nanoseconds now) const;

  /// Whether all received peers list us, and none lists a peer that we do not receive.
  [[nodiscard]] bool is_complete() const noexcept;

 private:
  void read(Hearing& hearing, const pdu::PeersHeard& list,
            std::chrono::nanoseconds now) const noexcept;
  void note_epochs(Hearing& hearing, const pdu::PeersHeard& list,
                   std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] bool is_unknown(std::uint32_t epoch) const noexcept;
  void note_listing(Peer& peer, std::chrono::nanoseconds now) const;
  void report_change(Peer& peer, std::chrono::nanoseconds now) const;

  const PresenceConfig& config_;
  const PeerTable& peers_;
  const Claims& claims_;
  const FormerLives& former_;
  const OwnIdentity& own_;
  const AnnouncementPace& pace_;
  PresenceEvents& events_;
};

}  // namespace reckon::aoim
