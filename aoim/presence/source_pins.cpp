// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/source_pins.hpp"

#include <algorithm>
#include <utility>

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// Time in which a sender at another address has to prove it, if the peer itself has, or has not.
constexpr milliseconds kProvesItself{2500}, kUnprovedProves{10'000};
// The old address may still be received this long after the first datagram from a new one.
constexpr milliseconds kMostLate{500};
// A key confirms or refutes a move on approval within this time, or it is undone.
constexpr milliseconds kApproval{4000};
// A hand in contact: touched just now, and received at 20 datagrams a second or more.
constexpr milliseconds kTouched{100}, kLongestInterval{50};
// Silence of its old address: this many intervals, but not more than this time.
constexpr int kMissed = 12;
constexpr milliseconds kSilence{400};

}  // namespace

void SourcePins::disclose(Peer& peer, const pdu::Presence& heard, nanoseconds now) {
  peer.opened = now;
  const Disclosure found =
      peer.proof.disclose(heard, peer.source, {config_.one_way, config_.keyed_hash});
  if (found.refuted.port != 0) peer.refuted = found.refuted;
  peer.doubtful = !found.proven && (peer.doubtful || found.is_source_refuted);
  if (found.is_source_refuted && peer.held.port != 0) move_back(peer);
  if (found.proven) {
    peer.may_hurry = true;
    if (*found.proven == peer.suspect) peer.suspect = {};
    if (*found.proven == peer.source) peer.held = {};
    if (*found.proven != peer.source) move(peer, *found.proven);
  }
  if (found.refuted.port != 0 && peer.proof.is_proved()) report_impostor(peer, found.refuted);
}

void SourcePins::note_proof(Peer& peer, const pdu::Presence& heard, nanoseconds now,
                            const SourceAddress& from) {
  const bool at_home = is_home(peer, from);
  if (!peer.proof.note(heard, now, from, at_home, config_.keyed_hash)) return;
  if (!peer.may_hurry || peer.held.port != 0 || from.octets == peer.refuted.octets) return;
  if (!peer.move) peer.move = Move{from, now};
  next_ = std::min(next_, now);
}

bool SourcePins::may_move(const Peer& peer, const pdu::Presence& heard, nanoseconds now,
                          const SourceAddress& from) const {
  if (from.port == 0 || peer.held.port != 0) return false;
  if (peer.proof.is_proved() && from.boot == 0) return false;
  const bool leaves = (heard.flags & pdu::kPresenceLeaving) != 0;
  return !leaves && now - peer.last_heard > config_.pin;
}

void SourcePins::move(Peer& peer, const SourceAddress& to) {
  const SourceAddress former = std::exchange(peer.source, to);
  peer.impostor_reported = false;
  peer.suspect = peer.held = {};
  peer.move.reset();
  events_.report(PresenceEventKind::moved, peer).other = former;
}

void SourcePins::move_on_approval(Peer& peer, nanoseconds now) {
  const SourceAddress former = peer.source;
  move(peer, peer.move->to);
  peer.held = former;
  peer.held_since = now;
  peer.proof.forget_home();
  peer.may_hurry = false;
  next_ = std::min(next_, now + kApproval);
}

void SourcePins::move_back(Peer& peer) { move(peer, SourceAddress(peer.held)); }

void SourcePins::note_impostor(Peer& peer, const SourceAddress& from, nanoseconds now) {
  note_sender(peer, from);
  if (from == peer.source || peer.impostor_reported || peer.suspect.port != 0) return;
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

void SourcePins::settle_suspect(Peer& peer, nanoseconds now) {
  if (peer.suspect.port == 0) return;
  const bool speaks =
      peer.held.port == 0 && !peer.doubtful && peer.last_heard > peer.suspected + kMostLate;
  nanoseconds due = peer.suspected + (peer.proof.is_proved() ? kProvesItself : kUnprovedProves);
  if (now >= due && speaks) return report_impostor(peer, peer.suspect);
  if (now >= due) due = now + kMostLate;
  next_ = std::min(next_, due);
}

void SourcePins::settle(Peer& peer, nanoseconds now) {
  settle_suspect(peer, now);
  if (peer.held.port != 0) {
    const nanoseconds due = peer.held_since + kApproval;
    if (now >= due) return move_back(peer);
    next_ = std::min(next_, due);
  }
  if (!peer.move) return;
  if (peer.last_heard > peer.move->since) return peer.move.reset();
  if (now - peer.touched > kTouched || peer.interval > kLongestInterval) return;
  const nanoseconds due =
      peer.last_heard + std::min<nanoseconds>(kMissed * peer.interval, kSilence);
  if (now >= due) return move_on_approval(peer, now);
  next_ = std::min(next_, due);
}

void SourcePins::report_impostor(Peer& peer, SourceAddress from) {
  if (from == peer.suspect) peer.suspect = {};
  if (peer.impostor_reported || from == peer.source) return;
  peer.impostor_reported = true;
  events_.report(PresenceEventKind::impostor, peer).other = from;
}

}  // namespace reckon::aoim
