// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/source_pins.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Time in which a sender at another address has to prove its identity.
constexpr std::chrono::milliseconds kProvesItself{500};

}  // namespace

// The owner has sent a replayed announcement before, so the owner was received from its own address
// unless that datagram was lost.
bool SourcePins::may_move(Peer& peer, const pdu::Presence& heard, nanoseconds now,
                          const SourceAddress& from) {
  if (from.port == 0) return false;
  if (!peer.tip.is_chained()) {
    const bool leaves = (heard.flags & pdu::kPresenceLeaving) != 0;
    return !leaves && now - peer.last_heard > config_.pin;
  }
  if (from == peer.former_source) return true;
  const bool same = peer.move && peer.move->to == from;
  const bool first = !peer.move || peer.move->announced.chain_number < heard.chain_number;
  if (!same && !first) return false;
  peer.move = Move{heard, from, same ? peer.move->since : now};
  next_ = std::min(next_, peer.move->since + config_.still);
  return false;
}

void SourcePins::move(Peer& peer, const SourceAddress& to) {
  peer.former_source = peer.source;
  peer.source = to;
  peer.impostor_reported = false;
  peer.suspect = {};
  events_.report(PresenceEventKind::moved, peer).other = peer.former_source;
}

void SourcePins::note_impostor(Peer& peer, const SourceAddress& from, nanoseconds now) {
  if (peer.impostor_reported || peer.suspect.port != 0) return;
  if (!peer.tip.is_chained() || from.port == 0) return report_impostor(peer, from);
  peer.suspect = from;
  peer.suspected = now;
  next_ = std::min(next_, now + kProvesItself);
}

void SourcePins::refuse(Peer& peer, const SourceAddress& from, nanoseconds now) {
  ++refused_;
  note_impostor(peer, from, now);
}

bool SourcePins::begin_settling(nanoseconds now) noexcept {
  if (now < next_) return false;
  next_ = nanoseconds::max();
  return true;
}

std::optional<Move> SourcePins::settle(Peer& peer, nanoseconds now) {
  if (peer.suspect.port != 0) {
    const nanoseconds due = peer.suspected + kProvesItself;
    if (now >= due) report_impostor(peer, peer.suspect);
    if (now < due) next_ = std::min(next_, due);
  }
  if (!peer.move) return {};
  const Move found = *peer.move;
  if (peer.last_heard > found.since) {
    peer.move.reset();
    ++refused_;
    report_impostor(peer, found.to);
  } else if (now >= found.since + config_.still) {
    move(peer, found.to);
    return found;
  } else {
    next_ = std::min(next_, found.since + config_.still);
  }
  return {};
}

void SourcePins::report_impostor(Peer& peer, SourceAddress from) {
  peer.suspect = {};
  if (peer.impostor_reported || from == peer.source) return;
  peer.impostor_reported = true;
  events_.report(PresenceEventKind::impostor, peer).other = from;
}

}  // namespace reckon::aoim
