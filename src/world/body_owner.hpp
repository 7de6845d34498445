// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner of a scene's bodies: the first peer of the scene, according to its announcement.
#pragma once

#include <cstdint>
#include <optional>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::peer {

/// A peer that announces the number of the scene's first peer while another has it.
struct BodyRival {
  aoim::PeerId name, owner;
  aoim::SourceAddress from;
};

/// The epoch that owns the bodies. If several peers announce number 1, the first received one owns
/// them until it leaves. One thread; no allocation; linear in the peers.
class BodyOwner {
 public:
  /// Finds owner and rival among the peers. Call it some times a second.
  void look(const aoim::Presence& presence) noexcept {
    const bool own_first = presence.own().scene_peer == 1;
    const aoim::Peer *owner = nullptr, *last = nullptr;
    const auto is_owner = [&](const aoim::Peer& peer) { return peer.announced.epoch == epoch_; };
    for (const aoim::Peer& peer : presence.peers()) {
      if (!peer.joined || peer.announced.scene_peer != 1) continue;
      const bool first = owner == nullptr || peer.known_since < owner->known_since;
      if (is_owner(peer) || (first && !(owner != nullptr && is_owner(*owner)))) owner = &peer;
      if (last == nullptr || peer.known_since > last->known_since) last = &peer;
    }
    epoch_ = own_first ? presence.own().epoch : owner == nullptr ? 0 : owner->announced.epoch;
    rival_.reset();
    if (last != nullptr && (own_first || last != owner))
      rival_ = {last->id(), own_first ? presence.id() : owner->id(), last->source};
  }
  /// Epoch of the owner, perhaps of this peer; 0 if it is not known.
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_; }
  /// The last peer other than the owner to announce number 1, if there is one.
  [[nodiscard]] const std::optional<BodyRival>& rival() const noexcept { return rival_; }

 private:
  std::uint32_t epoch_ = 0;
  std::optional<BodyRival> rival_;
};

}  // namespace reckon::peer
