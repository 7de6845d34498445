// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/peer_watches.hpp"

namespace reckon::peer {

PeerWatches::PeerWatches(const ModelWiring& wiring)
    : muted_(wiring.muted),
      refused_(wiring.refused),
      interop_(wiring.scene.network.interop),
      notices_(256),
      silence_watch_(wiring.counters) {}

void PeerWatches::report(const aoim::PresenceEvent& event, Nanoseconds now) noexcept {
  // The sender of a discovery request is no peer yet.
  if (event.announced.scene_peer == pdu::kScenePeerWanted) return;
  notice_gate_.report(event, now, notices_);
}

void PeerWatches::look(RemoteEntities& remote, const aoim::PeerId& own, Nanoseconds now) noexcept {
  while (const MutedSender* sender = muted_ == nullptr ? nullptr : muted_->front()) {
    notice_gate_.report(*sender, now, notices_);
    muted_->pop();
  }
  while (const RefusedSender* sender = refused_ == nullptr ? nullptr : refused_->front()) {
    notice_gate_.report_refusal(notice_of(*sender, interop_), source_of(sender->who), now,
                                notices_);
    refused_->pop();
  }
  notice_gate_.look(now, notices_);
  refusal_watch_.look(remote, own, now);
  refusal_watch_.look(silence_watch_, now);
}

}  // namespace reckon::peer
