// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether we and the others hear each other, as their lists of peers heard report.
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
  /// All outlive this.
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

  /// The list of a claimant of an id.
  void read(Claimant& claimant, const pdu::PeersHeard& list,
            std::chrono::nanoseconds now) const noexcept {
    read(claimant.hears, list, now);
  }
  /// The list of a joined peer. Reports that it hears us late, does not hear us, or hears us again.
  void read(Peer& peer, const pdu::PeersHeard& list, std::chrono::nanoseconds now) const;

  /// Whether all whom we hear list us, and nobody lists one whom we do not hear.
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
