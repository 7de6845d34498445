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
  constexpr std::chrono::milliseconds kBurst{5}, kLongest{1000};
  constexpr int kSmoothing = 8;
  const nanoseconds gap = now - peer.last_heard;
  if (gap >= kBurst)
    peer.interval += (std::min<nanoseconds>(gap, kLongest) - peer.interval) / kSmoothing;
  if (now - peer.last_heard > config_.quiet) peer.back_since = now;
  peer.last_heard = std::max(peer.last_heard, now);
  peer.confirmed = true;
  look_ = look_ || peer.quiet;
}

// Time at which this silent peer is reported as quiet, or is lost. A revealed link proves that the
// peer is alive, even if another sender repeated it.
nanoseconds Liveness::silence_due(const Peer& peer) const noexcept {
  const bool is_next_lost = peer.quiet || !peer.joined;
  const nanoseconds last = is_next_lost ? std::max(peer.last_heard, peer.opened) : peer.last_heard;
  return last + (is_next_lost ? config_.patience() : config_.quiet) + nanoseconds(1);
}

void Liveness::watch(const Peer& peer) noexcept {
  silent_at_ = std::min(silent_at_, silence_due(peer));
  if (peer.joined) heard_since_ = std::min(heard_since_, peer.last_heard);
  look_ = look_ || peer.quiet;
}

bool Liveness::is_lost(Peer& peer, nanoseconds now) {
  const nanoseconds silence = now - peer.last_heard;
  if (now - std::max(peer.last_heard, peer.opened) > config_.patience()) return true;
  if (peer.joined && peer.quiet != (silence > config_.quiet)) {
    peer.quiet = !peer.quiet;
  }
  return false;
}

void Liveness::watch_all() noexcept {
  silent_at_ = heard_since_ = nanoseconds::max();
  for (const Peer& peer : peers_) watch(peer);
  look_ = false;
}

}  // namespace reckon::aoim
