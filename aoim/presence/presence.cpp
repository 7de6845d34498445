// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/presence.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

bool is_leaving(const pdu::Presence& heard) noexcept {
  return (heard.flags & pdu::kPresenceLeaving) != 0;
}

// Whether `heard` was said before `known` and came after it. A clock set back by more is believed.
bool is_overtaken(const pdu::Presence& heard, const pdu::Presence& known) noexcept {
  constexpr std::uint64_t kLongestDelay = 2'000'000'000;  // [ns]
  return heard.send_time < known.send_time && known.send_time - heard.send_time < kLongestDelay;
}

}  // namespace

Presence::Presence(const PresenceConfig& config, const pdu::Presence& own)
    : config_(config),
      own_(own),
      chain_(config.one_way, config.secret),
      peers_(config.capacity),
      events_(4 * config.capacity + 16) {
  config.check();
  if (own.epoch == 0) throw std::invalid_argument("presence: epoch 0; draw one at random");
  own_.flags = static_cast<std::uint16_t>(
      own_.flags & ~unsigned{pdu::kPresenceLeaving | pdu::kPresenceEstablished});
  claimants_.reserve(config.claims);
  crowds_.reserve(kCrowds);
  list_.reserve(config.capacity);
  outgoing_.reserve(8);
  farewells_.reserve(8);
}

void Presence::start(nanoseconds now) {
  running_ = true;
  claimed_ = now;
  announce_soon(now);
}

void Presence::stop() {
  if (!running_) return;
  running_ = false;
  farewells_.push_back(own_);
}

// There is room for it.
void Presence::append(const Peer& peer) {
  peers_.append(peer);
  watch(peer);
}

void Presence::note_heard(Peer& peer, nanoseconds now) noexcept {
  if (now - peer.last_heard > config_.quiet) peer.back_since = now;
  peer.last_heard = std::max(peer.last_heard, now);
  peer.confirmed = true;
  look_ = look_ || peer.quiet;
}

bool Presence::shares_scene(const pdu::Presence& heard) const noexcept {
  const auto key = [](const pdu::Presence& one) {
    return std::tie(one.scene_hash, one.cell_scheme, one.cell_size, one.pool_size, one.port);
  };
  return key(heard) == key(own_);
}

// Nobody could be heard while this process stood still, so nobody has been silent meanwhile.
void Presence::wake(nanoseconds now) {
  const nanoseconds last = awake_.value_or(now);
  awake_ = std::max(last, now);
  const nanoseconds slept = now - last;
  if (!running_ || slept <= config_.heartbeat + config_.minimum_gap) return;
  // What lay in the socket meanwhile has been heard just now.
  const auto later = [&](nanoseconds& time) { time = std::min(time + slept, now); };
  for (Peer& peer : peers_) later(peer.last_heard);
  look_ = true;
  for (Claimant& claimant : claimants_) {
    later(claimant.since);
    later(claimant.last_heard);
  }
  // The others have dropped us, and one may have taken our id.
  if (slept > config_.patience()) claimed_ = now;
  events_.report(PresenceEventKind::slept, own_).slept = slept;
  insist(now);
}

void Presence::receive(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  if (heard.header.exercise_id != own_.header.exercise_id || heard.epoch == 0) return;
  if (heard.epoch == own_.epoch) return;  // our echo, maybe under an id given up
  wake(now);
  ++counts_.heard;
  const std::size_t known = peers_.find_epoch(heard.epoch);
  if (known < peers_.size()) return hear_known(known, heard, now, from);
  if (takes_back(heard, now, from)) return;
  if (is_over(heard, now, from)) {
    ++counts_.former_life;
    return;
  }
  if (!is_leaving(heard)) return claim(heard, now, from);
  const Claimant* claimant = find_claimant(heard.epoch);
  if (claimant != nullptr && may_speak(claimant->source, from)) forget_claimant(heard.epoch);
}

void Presence::hear_known(std::size_t index, const pdu::Presence& heard, nanoseconds now,
                          const SourceAddress& from) {
  Peer& peer = peers_[index];
  const bool at_home = may_speak(peer.source, from);
  const Opening opening = judge(peer.tip, heard, now, at_home);
  if (at_home && opening == Opening::known) return note_heard(peer, now);  // a copy, or overtaken
  const bool is_refused = opening == Opening::wrong || opening == Opening::known;
  const bool proves = opening == Opening::newer;
  if (is_refused || (!at_home && !may_move(peer, heard, now, from))) {
    if (proves) return;  // it may have moved
    ++counts_.impostors;
    return note_impostor(heard.epoch, from, now);
  }
  if (!at_home) move(peer, from);
  believe(index, heard, now, from);
}

void Presence::believe(std::size_t index, const pdu::Presence& heard, nanoseconds now,
                       const SourceAddress& from) {
  Peer& peer = peers_[index];
  peer.tip = LifeTip(heard, now);
  peer.move.reset();
  if (is_leaving(heard)) {
    const PeerId known_as = peer.id();
    peer.announced = heard;
    peer.announced.simulation = known_as;  // whatever it was called at last
    bury(peer, now, true);
    remove(index, PresenceEventKind::departed);
    fill_free_ids(now);
    return;
  }
  if (heard.simulation != peer.id()) {
    if (is_overtaken(heard, peer.announced)) return;
    return rename(index, heard, now, from);
  }
  const bool joined = shares_scene(heard);
  const bool changes = joined != peer.joined;
  note_heard(peer, now);
  peer.announced = heard;
  peer.joined = joined;
  peer.source = from;
  if (changes)
    events_.report(joined ? PresenceEventKind::newcomer : PresenceEventKind::scene_mismatch, peer);
  watch(peer);
}

// It has lost its id to another, or found it taken; its life goes on.
void Presence::rename(std::size_t index, const pdu::Presence& heard, nanoseconds now,
                      const SourceAddress& from) {
  Peer moved = peers_[index];
  const Peer before = moved;
  peers_.erase(index);
  if (is_taken(heard.simulation)) {
    if (moved.joined) events_.report(PresenceEventKind::departed, before);
    claim(heard, now, from);
    fill_free_ids(now);
    return;
  }
  moved.announced = heard;
  moved.last_heard = now;
  moved.joined = shares_scene(heard);
  moved.source = from;
  append(moved);
  forget_claimant(heard.epoch);
  if (moved.joined) {
    events_.report(PresenceEventKind::renamed, moved).former = before.id();
  }
  announce_soon(now);
  fill_free_ids(now);
}

void Presence::welcome(const pdu::Presence& heard, nanoseconds now, const SourceAddress& from) {
  if (!make_room(now, from)) return;
  Peer peer;
  peer.announced = heard;
  peer.first_heard = peer.last_heard = peer.known_since = now;
  peer.joined = shares_scene(heard);
  peer.source = from;
  peer.tip = LifeTip(heard, now);
  if (const auto before = former_.take(heard.epoch)) {
    peer.known_since = before->known_since;
    peer.back_since = now;
  }
  append(peer);
  events_.report(peer.joined ? PresenceEventKind::newcomer : PresenceEventKind::scene_mismatch,
                 peer);
  announce_soon(now);
}

void Presence::begin_life(std::size_t index, const Claimant& claimant, nanoseconds now) {
  const std::uint32_t over = peers_.epoch(index);
  bury(peers_[index], now, false);
  Peer peer;
  peer.announced = claimant.announced;
  peer.first_heard = peer.known_since = claimant.since;
  peer.last_heard = claimant.last_heard;
  peer.joined = shares_scene(claimant.announced);
  peer.source = claimant.source;
  peer.hears = claimant.hears;
  peer.tip = claimant.tip;
  peers_.replace(index, peer);
  watch(peer);
  events_
      .report(peer.joined ? PresenceEventKind::restarted : PresenceEventKind::scene_mismatch, peer)
      .former_epoch = over;
  announce_soon(now);
}

void Presence::bury(const Peer& peer, nanoseconds now, bool said_goodbye) {
  former_.add({peer.id(), peer.announced.epoch, now, peer.source, peer.tip, peer.known_since,
               peer.last_heard, said_goodbye});
}

void Presence::remove(std::size_t index, PresenceEventKind why) {
  const bool may_return = why == PresenceEventKind::timed_out && peers_[index].tip.is_chained();
  if (may_return && awake_) bury(peers_[index], *awake_, false);
  events_.report(why, peers_[index]);
  peers_.erase(index);
}

// When this one is to be reported as quiet, or is lost, if it says nothing more.
nanoseconds Presence::silence_due(const Peer& peer) const noexcept {
  const nanoseconds bound = peer.quiet || !peer.joined ? config_.patience() : config_.quiet;
  return peer.last_heard + bound + nanoseconds(1);
}

void Presence::watch(const Peer& peer) noexcept {
  silent_at_ = std::min(silent_at_, silence_due(peer));
  if (peer.joined) heard_since_ = std::min(heard_since_, peer.last_heard);
  look_ = look_ || peer.quiet;
}

// All are looked at when the first of them may have been silent for long, not in each step.
void Presence::watch_silence(nanoseconds now) {
  if (!look_ && now < silent_at_) return;
  for (std::size_t i = peers_.size(); i-- > 0;) {
    Peer& peer = peers_[i];
    const nanoseconds silence = now - peer.last_heard;
    if (silence > config_.patience()) {
      remove(i, PresenceEventKind::timed_out);
    } else if (peer.joined && peer.quiet != (silence > config_.quiet)) {
      peer.quiet = !peer.quiet;
      events_.report(peer.quiet ? PresenceEventKind::quiet : PresenceEventKind::heard_again, peer);
    }
  }
  silent_at_ = heard_since_ = nanoseconds::max();
  for (const Peer& peer : peers_) watch(peer);
  look_ = false;
}

// Who rises may be silent already, and who rises may fall to another.
void Presence::settle(nanoseconds now) {
  do watch_silence(now);
  while (settle_claims(now));
}

std::span<const pdu::Presence> Presence::step(nanoseconds now) {
  wake(now);
  settle_moves(now);
  settle(now);
  const PeerId before = id();
  look_at_own_id(now);
  if (id() != before) settle(now);  // who else claims the number that we gave up
  std::swap(outgoing_, farewells_);
  farewells_.clear();
  for (pdu::Presence& farewell : outgoing_) {
    farewell.flags |= pdu::kPresenceLeaving;
    chain_.sign(farewell);
  }

  if (is_due(now)) {
    own_.flags = static_cast<std::uint16_t>(own_.flags & ~unsigned{pdu::kPresenceEstablished});
    if (is_established(now)) own_.flags |= pdu::kPresenceEstablished;
    outgoing_.push_back(own_);
    chain_.sign(outgoing_.back());
    last_ = now;
    if (next_cause_ != Cause::heartbeat) next_list_ = now;
    schedule_next(now);
  }
  counts_.announced += outgoing_.size();
  return outgoing_;
}

Standing Presence::standing(std::uint32_t epoch, const SourceAddress* from) const noexcept {
  if (epoch == own_.epoch) return Standing::own;
  const std::size_t known = peers_.find_epoch(epoch);
  if (known < peers_.size()) {
    const Peer& peer = peers_[known];
    if (from != nullptr && !may_speak(peer.source, *from)) return Standing::impostor;
    return peer.joined ? Standing::member : Standing::other_scene;
  }
  return former_.contains(epoch) ? Standing::former_life : Standing::unknown;
}

std::optional<std::uint32_t> Presence::epoch_of(PeerId id) const noexcept {
  const std::size_t known = peers_.find(id);
  if (known == peers_.size() || !peers_[known].joined) return {};
  return peers_.epoch(known);
}

std::optional<PeerId> Presence::id_of(std::uint32_t epoch) const noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size() || !peers_[known].joined) return {};
  return peers_[known].id();
}

std::optional<SourceAddress> Presence::source_of(std::uint32_t epoch) const noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size()) return {};
  return peers_[known].source;
}

nanoseconds Presence::heard_for(std::uint32_t epoch) const noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size()) return nanoseconds(0);
  return peers_[known].last_heard - peers_[known].known_since;
}

void Presence::note_alive(std::uint32_t epoch, nanoseconds now) noexcept {
  const std::size_t known = peers_.find_epoch(epoch);
  if (known == peers_.size()) return;
  note_heard(peers_[known], now);
}

nanoseconds Presence::next_step() const noexcept {
  if (!farewells_.empty()) return nanoseconds::min();
  nanoseconds next = nanoseconds::max();
  if (running_ && !yield_at_) next = next_;
  if (running_) next = std::min(next, next_list_);
  return std::min({next, silent_at_, next_move_, next_identity_step()});
}

}  // namespace reckon::aoim
