// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The half of presence that tells whom we hear, and reads whom others hear.
#include <algorithm>
#include <utility>

#include "reckon/aoim/presence/presence.hpp"

namespace reckon::aoim {

using std::chrono::nanoseconds;

namespace {

// A list that left so long after an announcement of ours tells of it.
constexpr std::chrono::milliseconds kUnderWay{30};

}  // namespace

// A part says nothing of those below its first and above its last.
void Presence::read_list(Hearing& hearing, const pdu::PeersHeard& list, nanoseconds now) noexcept {
  const auto epochs = pdu::records_of<pdu::PeerEpoch>(list.epochs);
  const bool below = (list.continues & pdu::kPeersHeardBelow) != 0;
  std::uint32_t first = 0, last = ~std::uint32_t{0};
  if (below || (list.continues & pdu::kPeersHeardAbove) != 0) {
    std::uint32_t lowest = last, highest = first;
    for (const pdu::PeerEpoch& heard : epochs) {
      lowest = std::min(lowest, heard.epoch);
      highest = std::max(highest, heard.epoch);
    }
    if (below) first = lowest;
    if ((list.continues & pdu::kPeersHeardAbove) != 0) last = highest;
  }
  const auto covers = [&](std::uint32_t epoch) { return first <= epoch && epoch <= last; };
  hearing.came = now;
  if (covers(own_.epoch)) {
    hearing.us = false;
    hearing.us_at = now;
  }
  if (covers(hearing.rival)) {
    hearing.rival = 0;
    hearing.rival_at = now;
  }
  if (!below) hearing.strangers = false;
  for (const pdu::PeerEpoch& heard : epochs) {
    if (heard.epoch == own_.epoch) hearing.us = true;
    if (peers_.find_epoch(heard.epoch) < peers_.size()) continue;
    const Claimant* claimant = find_claimant(heard.epoch);
    if (claimant != nullptr && claimant->announced.simulation == id()) {
      hearing.rival = heard.epoch;
      hearing.rival_at = now;
    }
    if (claimant == nullptr && standing(heard.epoch) == Standing::unknown) hearing.strangers = true;
  }
}

void Presence::receive(const pdu::PeersHeard& list, nanoseconds now, const SourceAddress& from) {
  if (list.header.exercise_id != own_.header.exercise_id) return;
  if (Claimant* claimant = find_claimant(list.epoch)) {
    if (may_speak(claimant->source, from)) read_list(claimant->hears, list, now);
    return;
  }
  const std::size_t known = peers_.find_epoch(list.epoch);
  if (known == peers_.size() || !peers_[known].joined) return;
  Peer& peer = peers_[known];
  if (!may_speak(peer.source, from)) {
    ++counts_.impostors;
    return note_impostor(list.epoch, from, now);
  }
  read_list(peer.hears, list, now);
  note_listing(peer, now);
  if (running_ && next_cause_ == Cause::repetition && is_acquainted()) {
    next_ = *last_ + config_.heartbeat;
    next_cause_ = Cause::heartbeat;
  }

  // Both have to have had the time to hear each other.
  const nanoseconds acquainted = std::max(peer.first_heard, claimed_) + config_.established +
                                 config_.list_round(peers_.size());
  if (peer.hears.us && peer.unheard) {
    peer.unheard = false;
    events_.report(PresenceEventKind::heard_again, peer);
  } else if (!peer.hears.us && peer.hears.us_at == now && !peer.unheard && running_ &&
             now > acquainted) {
    peer.unheard = true;
    events_.report(PresenceEventKind::unheard, peer);
  }
}

// What we introduce is lost on one that does not believe us yet, or has forgotten us.
void Presence::note_listing(Peer& peer, nanoseconds now) {
  Hearing& hears = peer.hears;
  if (!running_ || hears.us_at != now) return;
  if (hears.us) {
    if (std::exchange(hears.missed_us, false)) events_.report(PresenceEventKind::heard_late, peer);
    hears.us_listed = now;
  } else if (hears.us_listed > nanoseconds::min()) {
    hears.missed_us = hears.missed_us || now - hears.us_listed >
                                             config_.patience() + config_.list_round(peers_.size());
  } else {
    const bool greeted = last_ && *last_ >= peer.first_heard && now - *last_ > kUnderWay;
    hears.missed_us = hears.missed_us || greeted;
  }
}

// Those that follow the last part, which begins with the last of it, so that nobody who is not
// heard lies between two parts and seems not asked for.
HeardList Presence::next_part() {
  std::sort(list_.begin(), list_.end());
  const auto above = std::upper_bound(list_.begin(), list_.end(), listed_to_);
  const auto begin = above == list_.begin() ? above : above - 1;
  const auto first = static_cast<std::size_t>(begin - list_.begin());
  const std::size_t count = std::min(config_.part, list_.size() - first);
  HeardList part{std::span(list_).subspan(first, count)};
  const bool ends = first + count == list_.size();
  if (first > 0) part.continues |= pdu::kPeersHeardBelow;
  if (!ends) part.continues |= pdu::kPeersHeardAbove;
  listed_to_ = ends ? 0 : part.epochs.back();
  return part;
}

std::optional<HeardList> Presence::take_list(nanoseconds now, nanoseconds said) {
  if (!running_ || now < next_list_) return {};
  const nanoseconds silence = 3 * config_.heartbeat / 4;
  const nanoseconds next = yield_at_ ? now : next_;
  if (!last_ || *last_ != now) {
    const nanoseconds silent = std::max(said, last_.value_or(said)) + silence;
    if (now < silent) {
      next_list_ = next > now ? std::min(silent, next) : silent;
      return {};
    }
    next_list_ = next + silence;
  } else {
    next_list_ = now + silence;
  }
  list_.clear();
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    if (now - peers_[i].last_heard <= config_.listed) list_.push_back(peers_.epoch(i));
  }
  if (list_.size() > config_.most_listed) return next_part();
  return HeardList{list_};
}

}  // namespace reckon::aoim
