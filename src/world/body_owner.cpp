// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/body_owner.hpp"

namespace reckon::peer {

void BodyOwner::look(const aoim::Presence& presence) noexcept {
  const bool own_first = presence.own().scene_peer == 1;
  const aoim::Peer *owner = nullptr, *last = nullptr;
  const auto is_owner = [&](const aoim::Peer& peer) { return peer.announced.epoch == epoch_; };
  for (const aoim::Peer& peer : presence.peers()) {
    if (!peer.joined || peer.announced.scene_peer != 1) continue;
    const bool first = owner == nullptr || peer.known_since < owner->known_since;
    if (is_owner(peer) || (first && !(owner != nullptr && is_owner(*owner)))) owner = &peer;
    if (last == nullptr || peer.known_since > last->known_since) last = &peer;
  }
  epoch_ = own_first || owner == nullptr ? 0 : owner->announced.epoch;
  rival_.reset();
  if (last != nullptr && (own_first || last != owner))
    rival_ = {last->id(), own_first ? presence.id() : owner->id(), last->source};
}

}  // namespace reckon::peer
