// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/mutual_hearing.hpp"

#include <algorithm>
#include <utility>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// A list sent this long after an announcement of ours answers it.
constexpr std::chrono::milliseconds kUnderWay{30};

}  // namespace

void MutualHearing::read(Peer& peer, const pdu::PeersHeard& list, nanoseconds now) const {
  read(peer.hears, list, now);
  note_listing(peer, now);
  report_change(peer, now);
}

// A part covers only the epochs from its first to its last.
void MutualHearing::read(Hearing& hearing, const pdu::PeersHeard& list,
                         nanoseconds now) const noexcept {
  const auto epochs = pdu::records_of<pdu::PeerEpoch>(list.epochs);
  const bool below = (list.continues & pdu::kPeersHeardBelow) != 0;
  const bool above = (list.continues & pdu::kPeersHeardAbove) != 0;
  std::uint32_t first = 0, last = ~std::uint32_t{0};
  if (below || above) {
    std::uint32_t lowest = last, highest = first;
    for (const pdu::PeerEpoch& heard : epochs) {
      lowest = std::min(lowest, heard.epoch);
      highest = std::max(highest, heard.epoch);
    }
    if (below) first = lowest;
    if (above) last = highest;
  }
  const auto covers = [&](std::uint32_t epoch) { return first <= epoch && epoch <= last; };
  hearing.came = now;
  if (covers(own_.epoch())) {
    hearing.us = false;
    hearing.us_at = now;
  }
  if (covers(hearing.rival)) {
    hearing.rival = 0;
    hearing.rival_at = now;
  }
  if (!below) hearing.strangers = false;
  note_epochs(hearing, list, now);
}

void MutualHearing::note_epochs(Hearing& hearing, const pdu::PeersHeard& list,
                                nanoseconds now) const noexcept {
  for (const pdu::PeerEpoch& heard : pdu::records_of<pdu::PeerEpoch>(list.epochs)) {
    if (heard.epoch == own_.epoch()) hearing.us = true;
    if (peers_.find_epoch(heard.epoch) < peers_.size()) continue;
    const Claimant* claimant = claims_.find(heard.epoch);
    if (claimant != nullptr && claimant->id() == own_.id()) {
      hearing.rival = heard.epoch;
      hearing.rival_at = now;
    }
    if (claimant == nullptr && is_unknown(heard.epoch)) hearing.strangers = true;
  }
}

// True if no row has it.
bool MutualHearing::is_unknown(std::uint32_t epoch) const noexcept {
  return epoch != own_.epoch() && !former_.contains(epoch);
}

// A peer that has not accepted us yet, or has dropped us, loses our introduction.
void MutualHearing::note_listing(Peer& peer, nanoseconds now) const {
  Hearing& hears = peer.hears;
  if (!pace_.is_running() || hears.us_at != now) return;
  if (hears.us) {
    if (std::exchange(hears.missed_us, false)) events_.report(PresenceEventKind::heard_late, peer);
    hears.us_listed = now;
  } else if (hears.us_listed > nanoseconds::min()) {
    const nanoseconds forgotten = config_.patience() + config_.list_round(peers_.size());
    hears.missed_us = hears.missed_us || now - hears.us_listed > forgotten;
  } else {
    const auto last = pace_.last();
    const bool greeted = last && *last >= peer.first_heard && now - *last > kUnderWay;
    hears.missed_us = hears.missed_us || greeted;
  }
}

void MutualHearing::report_change(Peer& peer, nanoseconds now) const {
  // Both must have had the time to receive each other.
  const nanoseconds acquainted = std::max(peer.first_heard, own_.held_since()) +
                                 config_.established + config_.list_round(peers_.size());
  if (peer.hears.us && peer.unheard) {
    peer.unheard = false;
    events_.report(PresenceEventKind::heard_again, peer);
  } else if (!peer.hears.us && peer.hears.us_at == now && !peer.unheard && pace_.is_running() &&
             now > acquainted) {
    peer.unheard = true;
  }
}

bool MutualHearing::is_complete() const noexcept {
  bool anybody = false;
  for (const Peer& peer : peers_) {
    if (!peer.joined) continue;
    if (!peer.hears.us || peer.hears.strangers) return false;
    anybody = true;
  }
  return anybody && claims_.size() == 0;
}

}  // namespace reckon::aoim
