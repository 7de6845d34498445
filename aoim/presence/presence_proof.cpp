// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of presence that tells a peer that has moved, or comes back, from one that only says so.
#include <algorithm>

#include "reckon/aoim/presence/presence.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Calls of the function a second that wrong proofs from elsewhere may cost; those that are but a
// little ahead are looked at beyond that, too.
constexpr std::uint32_t kMostWrongSteps = 4096, kAlways = 4;
// Who speaks from elsewhere has so long to prove that he is the one.
constexpr std::chrono::milliseconds kProvesItself{500};
// A change of our own address is announced for so long.
constexpr std::chrono::milliseconds kTellMove{300};

}  // namespace

Opening Presence::judge(const LifeTip& tip, const pdu::Presence& heard, nanoseconds now,
                        bool at_home) noexcept {
  if (now - wrong_since_ >= std::chrono::seconds(1)) {
    wrong_since_ = now;
    wrong_steps_ = 0;
  }
  const bool is_tired = !at_home && wrong_steps_ >= kMostWrongSteps;
  const std::uint32_t most = is_tired ? kAlways : tip.farthest(now);
  const Opening opening = tip.judge(heard, config_.one_way, most);
  if (opening == Opening::wrong) wrong_steps_ += std::min(most, kChainLength);
  return opening;
}

// Who repeats what it hears has it only after its owner has said it: the owner is heard at its
// place, too, but where its own words were lost.
bool Presence::may_move(Peer& peer, const pdu::Presence& heard, nanoseconds now,
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
  next_move_ = std::min(next_move_, peer.move->since + config_.still);
  return false;
}

void Presence::move(Peer& peer, const SourceAddress& to) {
  peer.former_source = peer.source;
  peer.source = to;
  peer.impostor_told = false;
  peer.suspect = {};
  events_.report(PresenceEventKind::moved, peer).other = peer.former_source;
}

void Presence::settle_moves(nanoseconds now) {
  if (now < next_move_) return;
  next_move_ = nanoseconds::max();
  for (std::size_t i = peers_.size(); i-- > 0;) {
    Peer& peer = peers_[i];
    if (peer.suspect.port != 0) {
      const nanoseconds due = peer.suspected + kProvesItself;
      if (now >= due) tell_impostor(peer, peer.suspect);
      if (now < due) next_move_ = std::min(next_move_, due);
    }
    if (!peer.move) continue;
    const Move found = *peer.move;
    if (peer.last_heard > found.since) {
      peer.move.reset();
      ++counts_.impostors;
      tell_impostor(peer, found.to);
    } else if (now >= found.since + config_.still) {
      move(peer, found.to);
      believe(i, found.announced, now, found.to);
    } else {
      next_move_ = std::min(next_move_, found.since + config_.still);
    }
  }
}

void Presence::note_impostor(std::uint32_t epoch, const SourceAddress& from, nanoseconds now) {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size()) return;
  Peer& peer = peers_[known];
  if (peer.impostor_told || peer.suspect.port != 0) return;
  if (!peer.tip.is_chained() || from.port == 0) return tell_impostor(peer, from);
  peer.suspect = from;
  peer.suspected = now;
  next_move_ = std::min(next_move_, now + kProvesItself);
}

void Presence::tell_impostor(Peer& peer, SourceAddress from) {
  peer.suspect = {};
  if (peer.impostor_told || from == peer.source) return;
  peer.impostor_told = true;
  events_.report(PresenceEventKind::impostor, peer).other = from;
}

// A life that was taken for over comes back where it was, and who came meanwhile has its id.
bool Presence::takes_back(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  const FormerLife* life = former_.find(heard.epoch);
  if (life == nullptr || life->said_goodbye || life->id != heard.simulation) return false;
  if (from.port == 0 || from != life->source || now - life->last_heard > config_.take_back)
    return false;
  const std::size_t holder = peers_.find(life->id);
  if (holder == peers_.size()) return false;
  const bool came_later = peers_[holder].known_since > life->known_since;
  if (!came_later || peers_[holder].source.octets == from.octets) return false;
  if (judge(life->tip, heard, now, true) != Opening::newer) return false;
  // Who came lives, and looks for another id.
  const Peer loser = peers_[holder];
  remove(holder, PresenceEventKind::departed);
  if (claimants_.size() < config_.claims)
    claimants_.push_back(
        {loser.announced, now, loser.last_heard, loser.source, loser.hears, loser.tip});
  welcome(heard, now, from);
  return true;
}

void Presence::note_own_source(const SourceAddress& source, nanoseconds now) noexcept {
  if (source.port == 0 || source == own_source_) return;
  const bool is_first = own_source_.port == 0;
  own_source_ = source;
  if (is_first) return;
  insist_until_ = std::max(insist_until_, now + kTellMove);
  announce_soon(now);
}

}  // namespace reckon::aoim
