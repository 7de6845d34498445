// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/silence_watch.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

SilenceWatch::SilenceWatch(Counters& counters)
    : doubted_(
          counters.make("peers_doubted", "times that the entities of a silent peer were stopped")),
      faded_(counters.make("silent_in_contact", "bodies that faded out without updates")) {
  doubts_.reserve(aoim::PresenceConfig{}.capacity);
}

bool SilenceWatch::look(const aoim::Presence& presence, std::span<const Touched> touched,
                        RemoteEntities& remote, nanoseconds now,
                        haptics::SpscRing<Notice>& out) noexcept {
  if (looked_ < nanoseconds(0) || now - looked_ > kOwnPause) listening_since_ = now;
  looked_ = now;
  // A peer that has left has no entities.
  std::erase_if(doubts_,
                [&](const Doubt& doubt) { return !presence.source_of(doubt.epoch).has_value(); });
  const Look look{touched, remote, now, out};
  const bool all_heard =
      now - std::max(presence.heard_since(), listening_since_) <= kPatience && doubts_.empty();
  bool again = false;
  for (const aoim::Peer& peer : presence.peers()) {
    if (all_heard) break;
    if (peer.joined) again = look_at(peer, look) || again;
  }
  for (const Touched& hand : touched) look_at_touched(hand, presence, look);
  return again;
}

// True if it is received again.
bool SilenceWatch::look_at(const aoim::Peer& peer, const Look& look) noexcept {
  Doubt* doubt = find(peer.announced.epoch);
  if (doubt != nullptr && peer.last_heard > doubt->since) return believe(peer, *doubt, look), true;
  if (look.now - heard(peer) <= kPatience || (doubt != nullptr && doubt->whole)) return false;
  if (doubt == nullptr && doubts_.size() == doubts_.capacity()) return false;
  Doubt& now = doubt != nullptr ? *doubt : doubt_of(peer, look.now);
  now.whole = true;
  look.remote.doubt_peer(peer.announced.epoch, look.now);
  const bool is_touched =
      std::any_of(look.touched.begin(), look.touched.end(),
                  [&](const Touched& t) { return t.id.simulation() == peer.id(); });
  if (is_touched) report(peer, now, look);
  return false;
}

// If its owner has updated the touched hand since the touch began, and then sends for kNoNews
// without updating it, the force of the hand ends. If its owner is silent, the hand is doubted
// after kContactPatience, or after twice that time if the owner was silent since the touch began.
void SilenceWatch::look_at_touched(const Touched& touched, const aoim::Presence& presence,
                                   const Look& look) noexcept {
  const RemoteEntity* row = look.remote.find(touched.id);
  if (row == nullptr || row->doubted_at != RemoteEntity::kTrusted) return;
  if (row->epoch == 0 || row->type.kind != pdu::EntityKind::life_form)
    return look_at_body(touched, *row, look);
  const auto peers = presence.peers();
  const auto peer = std::find_if(peers.begin(), peers.end(), [&](const aoim::Peer& candidate) {
    return candidate.announced.epoch == row->epoch;
  });
  if (peer == peers.end()) return;
  const nanoseconds news = std::max(row->last_heard, listening_since_);
  if (row->last_heard > touched.since && peer->last_heard - news > kNoNews)
    return look.remote.end_force(touched.id);
  const nanoseconds last = heard(*peer);
  const nanoseconds due =
      last > touched.since ? last + kContactPatience : touched.since + 2 * kContactPatience;
  if (look.now <= due) return;
  Doubt* doubt = find(row->epoch);
  if (doubt == nullptr && doubts_.size() == doubts_.capacity()) return;
  look.remote.doubt(touched.id, look.now);
  report(*peer, doubt != nullptr ? *doubt : doubt_of(*peer, look.now), look);
}

// Bodies of one silent host share one time-out, so that many bodies in turn do not extend it.
nanoseconds SilenceWatch::pressed_since(const RemoteEntity& row, const Look& look) noexcept {
  const nanoseconds pressed = look.remote.note_pressed(row.id, look.now);
  if (row.epoch != 0) return pressed;
  const aoim::SourceAddress& from = look.remote.owner(row);
  auto host = std::ranges::find(hosts_, from.octets, &Host::octets);
  if (host == hosts_.end()) {
    host = std::ranges::min_element(hosts_, {}, &Host::since);
    *host = {from.octets, nanoseconds(-1), look.now};
  }
  const nanoseconds heard = look.remote.owner_heard(row);
  if (heard > host->heard) *host = {from.octets, heard, look.now};
  return std::min(pressed, host->since);
}

// A body without a hand, or any of a plain DIS program.
void SilenceWatch::look_at_body(const Touched& touched, const RemoteEntity& row,
                                const Look& look) noexcept {
  if (row.felt_until != RemoteEntity::kTrusted) return;
  const nanoseconds pressed = pressed_since(row, look);
  const bool unaware = row.epoch != 0 && row.last_heard <= touched.since;
  const nanoseconds patience = row.epoch == 0 ? kGuestPatience : kContactPatience;
  const nanoseconds since = std::max(pressed, listening_since_);
  if (look.now - since <= (unaware ? 2 * patience : patience)) return;
  last_faded_ = {row.id, look.remote.owner(row)};
  look.remote.fade(row.id, look.now);
  faded_.add();
}

void SilenceWatch::believe(const aoim::Peer& peer, Doubt& doubt, const Look& look) noexcept {
  look.remote.believe_peer(doubt.epoch, doubt.since, look.now);
  if (doubt.reported) {
    static_cast<void>(look.out.push(
        make_end(NoticeKind::hands_silent, "peer {}:{} is received again after {:.1f} s",
                 peer.id().site, peer.id().application, pdu::to_seconds(look.now - doubt.heard))));
  }
  doubts_.erase(doubts_.begin() + (&doubt - doubts_.data()));
}

void SilenceWatch::report(const aoim::Peer& peer, Doubt& doubt, const Look& look) noexcept {
  if (doubt.reported) return;
  doubt.reported = true;
  static_cast<void>(look.out.push(make_notice(
      NoticeKind::hands_silent, "peer {}:{} was silent for {:.2g} s: its hands are no longer felt",
      peer.id().site, peer.id().application, pdu::to_seconds(look.now - peer.last_heard))));
}

SilenceWatch::Doubt* SilenceWatch::find(std::uint32_t epoch) noexcept {
  const auto found = std::find_if(doubts_.begin(), doubts_.end(),
                                  [epoch](const Doubt& doubt) { return doubt.epoch == epoch; });
  return found == doubts_.end() ? nullptr : &*found;
}

SilenceWatch::Doubt& SilenceWatch::doubt_of(const aoim::Peer& peer, nanoseconds now) noexcept {
  doubted_.add();
  return doubts_.emplace_back(Doubt{peer.announced.epoch, peer.last_heard, now, false, false});
}

nanoseconds SilenceWatch::heard(const aoim::Peer& peer) const noexcept {
  return std::max(peer.last_heard, listening_since_);
}

}  // namespace reckon::peer
