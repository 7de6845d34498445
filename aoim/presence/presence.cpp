// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/presence.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

bool is_leaving(const pdu::Presence& heard) noexcept {
  return (heard.flags & pdu::kPresenceLeaving) != 0;
}

// Whether `heard` was sent before `known` and received after it, unless a clock was set back.
bool is_overtaken(const pdu::Presence& heard, const pdu::Presence& known) noexcept {
  constexpr std::uint64_t kLongestDelay = 2'000'000'000;  // [ns]
  return heard.send_time < known.send_time && known.send_time - heard.send_time < kLongestDelay;
}

}  // namespace

Presence::Presence(const PresenceConfig& config, const pdu::Presence& own)
    : config_(config),
      peers_(config.capacity),
      events_(4 * config.capacity + 16),
      chain_({config.one_way, config.keyed_hash}, config.secret),
      proofs_(config.one_way),
      liveness_(config_, peers_, events_),
      pins_(config_, events_),
      claims_(config_, peers_, events_),
      admission_(config_, peers_, claims_, events_),
      pace_(config_),
      own_(config_, own, peers_, claims_, pace_, events_),
      hearing_(config_, peers_, claims_, former_, own_, pace_, events_),
      lists_(config_, peers_) {
  config.check(own);
  outgoing_.reserve(8);
  leaving_.reserve(8);
}

void Presence::start(nanoseconds now) {
  own_.hold_from(now);
  pace_.start(now);
}

void Presence::stop() {
  if (!pace_.is_running()) return;
  pace_.stop();
  leaving_.push_back(own());
}

// The others have dropped us after this time, and one may have taken our ID.
void Presence::wake(nanoseconds now) {
  const nanoseconds slept = liveness_.wake(now);
  if (!pace_.is_running() || slept <= config_.heartbeat + config_.minimum_gap) return;
  liveness_.note_slept(slept, now);
  claims_.note_slept(slept, now);
  if (slept > config_.patience()) own_.hold_from(now);
  events_.report(PresenceEventKind::slept, own()).slept = slept;
  pace_.insist(now);
}

// Ignores our echo, perhaps with an ID that we gave up, and an ID that no peer may have.
void Presence::receive(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  if (heard.header.exercise_id != own().header.exercise_id || heard.epoch == 0) return;
  if (heard.epoch == own_.epoch() || admission_.is_reserved(heard, from)) return;
  wake(now);
  ++counts_.heard;
  const std::size_t known = peers_.find_epoch(heard.epoch);
  if (known < peers_.size()) return receive_from_known(known, heard, now, from);
  if (takes_back(heard, now, from)) return;
  if (former_.is_over(heard, now, from, proofs_, config_.pin)) {
    ++counts_.former_life;
    return;
  }
  if (!is_leaving(heard)) return claim(heard, now, from);
  const Claimant* claimant = claims_.find(heard.epoch);
  if (claimant != nullptr && may_speak(claimant->source, from)) claims_.forget(heard.epoch);
}

void Presence::receive_from_known(std::size_t index, const pdu::Presence& heard, nanoseconds now,
                                  const SourceAddress& from) {
  Peer& peer = peers_[index];
  pins_.note_sender(peer, from);
  const Opening opening = proofs_.judge(peer.tip, heard, now, SourcePins::is_home(peer, from));
  const bool opens = opening == Opening::newer;
  const bool proves = opens || peer.tip.has_link_of(heard);
  if (opens) pins_.disclose(peer, heard, now);
  if (proves) pins_.note_proof(peer, heard, now, from);
  const bool at_home = SourcePins::is_home(peer, from);
  if (at_home && opening == Opening::known) return liveness_.note_heard(peer, now);  // a copy
  const bool is_refused = opening == Opening::wrong || opening == Opening::known;
  if (is_refused || (!at_home && !pins_.may_move(peer, heard, now, from))) {
    if (proves) return;  // its address may have changed
    return pins_.refuse(peer, from, now);
  }
  if (!at_home) pins_.move(peer, from);
  believe(index, heard, now, from);
}

void Presence::believe(std::size_t index, const pdu::Presence& heard, nanoseconds now,
                       const SourceAddress& from) {
  Peer& peer = peers_[index];
  peer.tip = LifeTip(heard, now);
  if (is_leaving(heard)) {
    const PeerId known_as = peer.id();
    peer.announced = heard;
    peer.announced.simulation = known_as;  // its last ID
    bury(peer, now, true);
    remove(index, PresenceEventKind::departed);
    fill_free_ids(now);
    return;
  }
  if (heard.simulation != peer.id()) {
    if (is_overtaken(heard, peer.announced)) return;
    return rename(index, heard, now, from);
  }
  const bool joined = own_.shares_scene(heard);
  const bool changes = joined != peer.joined;
  liveness_.note_heard(peer, now);
  peer.announced = heard;
  peer.joined = joined;
  peer.source = from;
  if (changes) {
    events_.report(joined ? PresenceEventKind::newcomer : PresenceEventKind::scene_mismatch, peer);
  }
  liveness_.watch(peer);
}

// It has lost its ID to another; its epoch continues.
void Presence::rename(std::size_t index, const pdu::Presence& heard, nanoseconds now,
                      const SourceAddress& from) {
  Peer moved = peers_[index];
  const Peer before = moved;
  peers_.erase(index);
  if (own_.is_taken(heard.simulation)) {
    if (moved.joined) events_.report(PresenceEventKind::departed, before);
    claim(heard, now, from);
    fill_free_ids(now);
    return;
  }
  moved.announced = heard;
  moved.last_heard = now;
  moved.joined = own_.shares_scene(heard);
  moved.source = from;
  append(moved);
  claims_.forget(heard.epoch);
  if (moved.joined) events_.report(PresenceEventKind::renamed, moved).former = before.id();
  pace_.announce_soon(now);
  fill_free_ids(now);
}

// A peer that is not in the table announces itself.
void Presence::claim(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  Claimant* claimant = claims_.find(heard.epoch);
  if (claimant != nullptr && !claims_.may_speak_for(*claimant, from)) return pins_.refuse();
  if (!own_.is_taken(heard.simulation)) {
    claims_.forget(heard.epoch);
    return welcome(heard, now, from);
  }
  if (claimant == nullptr) {
    if (admission_.is_crowd(from, own())) return;
    if (claims_.is_full()) {
      ++counts_.table_full;
      return;
    }
    claimant = &claims_.add({heard, now, now, from, {}, {}});
    pace_.insist(now);
  }
  claimant->receive(heard, now, from);
  if (heard.simulation != id()) return;
  ++counts_.conflicts;
  own_.resolve_conflict_with(*claimant, now);
}

void Presence::welcome(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  if (!make_room(now, from)) return;
  Peer peer;
  peer.announced = heard;
  peer.first_heard = peer.last_heard = peer.known_since = now;
  peer.joined = own_.shares_scene(heard);
  peer.source = from;
  peer.tip = LifeTip(heard, now);
  pins_.note_proof(peer, heard, now, from);
  if (const auto before = former_.take(heard.epoch)) {
    peer.known_since = before->known_since;
    peer.back_since = now;
  }
  append(peer);
  events_.report(peer.joined ? PresenceEventKind::newcomer : PresenceEventKind::scene_mismatch,
                 peer);
  pace_.announce_soon(now);
}

void Presence::begin_life(std::size_t index, const Claimant& claimant, nanoseconds now) {
  const std::uint32_t over = peers_.epoch(index);
  bury(peers_[index], now, false);
  Peer peer;
  peer.announced = claimant.announced;
  peer.first_heard = peer.known_since = claimant.since;
  peer.last_heard = claimant.last_heard;
  peer.joined = own_.shares_scene(claimant.announced);
  peer.source = claimant.source;
  peer.hears = claimant.hears;
  peer.tip = claimant.tip;
  peers_.replace(index, peer);
  liveness_.watch(peer);
  const auto kind = peer.joined ? PresenceEventKind::restarted : PresenceEventKind::scene_mismatch;
  events_.report(kind, peer).former_epoch = over;
  pace_.announce_soon(now);
}

// An epoch that was considered ended returns at its old address, and a newcomer has its ID.
bool Presence::takes_back(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  const FormerLife* life = former_.find(heard.epoch);
  if (life == nullptr || life->has_announced_end || life->id != heard.simulation) return false;
  if (from.port == 0 || from != life->source || now - life->last_heard > config_.take_back)
    return false;
  const std::size_t holder = peers_.find(life->id);
  if (holder == peers_.size()) return false;
  const bool came_later = peers_[holder].known_since > life->known_since;
  if (!came_later || peers_[holder].source.octets == from.octets) return false;
  if (proofs_.judge(life->tip, heard, now, true) != Opening::newer) return false;
  // The newcomer is alive and looks for another ID.
  const Peer loser = peers_[holder];
  remove(holder, PresenceEventKind::departed);
  if (!claims_.is_full())
    claims_.add({loser.announced, now, loser.last_heard, loser.source, loser.hears, loser.tip});
  welcome(heard, now, from);
  return true;
}

bool Presence::make_room(nanoseconds now, const SourceAddress& from) {
  if (admission_.is_crowd(from, own())) return false;
  if (peers_.size() < config_.capacity) return true;
  if (const auto stale = admission_.stale_row(now)) {
    remove(*stale, PresenceEventKind::timed_out);
    return true;
  }
  ++counts_.table_full;
  return false;
}

// The table has room for it.
void Presence::append(const Peer& peer) {
  peers_.append(peer);
  liveness_.watch(peer);
}

void Presence::bury(const Peer& peer, nanoseconds now, bool has_announced_end) {
  former_.add({peer.id(), peer.announced.epoch, now, peer.source, peer.tip, peer.known_since,
               peer.last_heard, has_announced_end});
}

void Presence::remove(std::size_t index, PresenceEventKind why) {
  const bool may_return = why == PresenceEventKind::timed_out && peers_[index].tip.is_chained();
  const auto awake = liveness_.awake();
  if (may_return && awake) bury(peers_[index], *awake, false);
  events_.report(why, peers_[index]);
  peers_.erase(index);
}

void Presence::receive(const pdu::PeersHeard& list, nanoseconds now, const SourceAddress& from) {
  if (list.header.exercise_id != own().header.exercise_id) return;
  if (Claimant* claimant = claims_.find(list.epoch)) {
    if (may_speak(claimant->source, from)) hearing_.read(*claimant, list, now);
    return;
  }
  const std::size_t known = peers_.find_epoch(list.epoch);
  if (known == peers_.size() || !peers_[known].joined) return;
  Peer& peer = peers_[known];
  if (!may_speak(peer.source, from)) return pins_.refuse(peer, from, now);
  hearing_.read(peer, list, now);
  if (pace_.is_repeating() && hearing_.is_complete()) pace_.end_repetition();
}

void Presence::note_impostor(std::uint32_t epoch, const SourceAddress& from, nanoseconds now) {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known < peers_.size()) pins_.note_impostor(peers_[known], from, now);
}

void Presence::note_touched(std::uint32_t epoch, nanoseconds now) noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known < peers_.size()) peers_[known].touched = now;
}

void Presence::note_alive(std::uint32_t epoch, nanoseconds now) noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size()) return;
  liveness_.note_heard(peers_[known], now);
}

void Presence::settle_silence(nanoseconds now) {
  if (!liveness_.is_due(now)) return;
  for (std::size_t i = peers_.size(); i-- > 0;) {
    if (liveness_.is_lost(peers_[i], now)) remove(i, PresenceEventKind::timed_out);
  }
  liveness_.watch_all();
}

bool Presence::settle_claims(nanoseconds now) {
  bool risen_any = false;
  for (std::size_t i = claims_.size(); i-- > 0;) {
    const auto risen = claims_.settle(i, id(), now);
    if (!risen) continue;
    begin_life(peers_.find(risen->id()), *risen, now);
    risen_any = true;
  }
  return fill_free_ids(now) || risen_any;
}

// Gives an ID that its holder gave up to the best of its claimants.
bool Presence::fill_free_ids(nanoseconds now) {
  bool any = false;
  while (const auto risen = claims_.take_free(id(), now)) {
    any = true;
    welcome(risen->announced, now, risen->source);
    const std::size_t place = peers_.find_epoch(risen->epoch());
    if (place == peers_.size()) continue;  // no room
    // It may have been silent since its claim.
    peers_[place].hears = risen->hears;
    peers_[place].tip = risen->tip;
    peers_[place].last_heard = risen->last_heard;
    liveness_.watch(peers_[place]);
  }
  return any;
}

// A promoted claimant may be silent already, and may lose to another one.
void Presence::settle(nanoseconds now) {
  do settle_silence(now);
  while (settle_claims(now));
}

std::span<const pdu::Presence> Presence::step(nanoseconds now, nanoseconds utc,
                                              std::uint32_t timestamp) {
  wake(now);
  if (pins_.begin_settling(now)) {
    for (Peer& peer : peers_) pins_.settle(peer, now);
  }
  settle(now);
  if (own_.step(now)) {
    fill_free_ids(now);
    settle(now);  // other claimants of the ID that we gave up
  }
  std::swap(outgoing_, leaving_);
  leaving_.clear();
  for (pdu::Presence& leaving : outgoing_) leaving.flags |= pdu::kPresenceLeaving;
  const bool announces = is_due(now);
  if (announces) {
    outgoing_.push_back(own_.announce(now));
    if (pace_.note_announced(now, hearing_.is_complete())) lists_.send_now(now);
  }
  for (pdu::Presence& announced : outgoing_) {
    announced.send_time = static_cast<std::uint64_t>(utc.count());
    announced.header.timestamp = timestamp;
    chain_.sign(announced, pace_.own_source(), now);
  }
  if (announces && config_.one_way != nullptr) pace_.align(chain_.slot_time());
  counts_.announced += outgoing_.size();
  return outgoing_;
}

std::optional<HeardList> Presence::take_list(nanoseconds now, nanoseconds last_sent) {
  if (!pace_.is_running()) return {};
  return lists_.take(now, last_sent, pace_.last(), own_.is_yielding() ? now : pace_.next());
}

Standing Presence::standing(std::uint32_t epoch, const SourceAddress* from) const noexcept {
  if (epoch == own_.epoch()) return Standing::own;
  const std::size_t known = peers_.find_epoch(epoch);
  if (known < peers_.size()) {
    const Peer& peer = peers_[known];
    if (from != nullptr && !may_speak(peer.source, *from)) return Standing::impostor;
    return peer.joined ? Standing::member : Standing::other_scene;
  }
  return former_.contains(epoch) ? Standing::former_life : Standing::unknown;
}

PresenceCounts Presence::counts() const noexcept {
  PresenceCounts sum = counts_;
  sum.crowd = admission_.refused();
  sum.reserved = admission_.reserved();
  sum.impostors = pins_.refused();
  return sum;
}

nanoseconds Presence::next_step() const noexcept {
  if (!leaving_.empty()) return nanoseconds::min();
  nanoseconds next = nanoseconds::max();
  if (pace_.is_running()) next = lists_.next_step();
  if (pace_.is_running() && !own_.is_yielding()) next = std::min(next, pace_.next());
  const nanoseconds looked = liveness_.awake().value_or(nanoseconds::min());
  return std::min({next, liveness_.next_step(), pins_.next_step(), own_.next_step(),
                   claims_.next_step(id(), looked)});
}

}  // namespace reckon::aoim
