// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/peer_watches.hpp"

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {

PeerWatches::PeerWatches(const ModelWiring& wiring)
    : muted_(wiring.muted),
      notices_(256),
      limit_watch_(wiring.capacity, wiring.counters),
      silence_watch_(wiring.counters),
      channel_keeper_(wiring.scene.aoim.awareness),
      link_watch_(wiring.link, wiring.pool.base(), wiring.counters),
      known_(wiring.known) {}

void PeerWatches::report(const aoim::PresenceEvent& event, Nanoseconds now) noexcept {
  // One that calls the roll is no peer yet.
  if (event.announced.scene_peer == pdu::kScenePeerWanted) return;
  notice_gate_.tell(event, now, notices_);
}

void PeerWatches::fit_channels(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                               Nanoseconds now) noexcept {
  channel_keeper_.look(remote, aoim, now, notices_);
}

void PeerWatches::look(RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                       std::size_t unfelt, const aoim::SourceAddress& crowder,
                       Nanoseconds now) noexcept {
  while (const MutedSender* sender = muted_ == nullptr ? nullptr : muted_->front()) {
    notice_gate_.tell(*sender, now, notices_);
    muted_->pop();
  }
  known_.publish(aoim.presence());
  notice_gate_.look(now, notices_);
  refusal_watch_.look(remote, aoim.presence().id(), now);
  limit_watch_.look(unfelt, crowder, remote.last_refused(), now, notices_);
  link_watch_.look(now, notices_);
  aoim.note_own_source(source_of(link_watch_.own_endpoint(), 0), now);
}

}  // namespace reckon::peer
