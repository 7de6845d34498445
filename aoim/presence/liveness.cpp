// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/liveness.hpp"

#include <algorithm>

namespace reckon::aoim {

using std::chrono::nanoseconds;

nanoseconds Liveness::wake(nanoseconds now) noexcept {
  const nanoseconds last = awake_.value_or(now);
  awake_ = std::max(last, now);
  return now - last;
}

// Datagrams that lay in the socket meanwhile were received just now.
void Liveness::note_slept(nanoseconds slept, nanoseconds now) noexcept {
  for (Peer& peer : peers_) peer.last_heard = std::min(peer.last_heard + slept, now);
  look_ = true;
}

void Liveness::note_heard(Peer& peer, nanoseconds now) noexcept {
  if (now - peer.last_heard > config_.quiet) peer.back_since = now;
  peer.last_heard = std::max(peer.last_heard, now);
  peer.confirmed = true;
  look_ = look_ || peer.quiet;
}

// When this silent peer is to be reported as quiet, or is lost.
nanoseconds Liveness::silence_due(const Peer& peer) const noexcept {
  const nanoseconds bound = peer.quiet || !peer.joined ? config_.patience() : config_.quiet;
  return peer.last_heard + bound + nanoseconds(1);
}

void Liveness::watch(const Peer& peer) noexcept {
  silent_at_ = std::min(silent_at_, silence_due(peer));
  if (peer.joined) heard_since_ = std::min(heard_since_, peer.last_heard);
  look_ = look_ || peer.quiet;
}

bool Liveness::is_lost(Peer& peer, nanoseconds now) {
  const nanoseconds silence = now - peer.last_heard;
  if (silence > config_.patience()) return true;
  if (peer.joined && peer.quiet != (silence > config_.quiet)) {
    peer.quiet = !peer.quiet;
    events_.report(peer.quiet ? PresenceEventKind::quiet : PresenceEventKind::heard_again, peer);
  }
  return false;
}

void Liveness::watch_all() noexcept {
  silent_at_ = heard_since_ = nanoseconds::max();
  for (const Peer& peer : peers_) watch(peer);
  look_ = false;
}

}  // namespace reckon::aoim
