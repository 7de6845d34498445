// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace reckon::aoim {
namespace {

constexpr std::size_t kFormerLives = 64;

// A total order that both sides of a dispute compute alike and that no restart turns round: the
// process that started first keeps the id; of two in the same second, the lower epoch.
bool keeps_id(const pdu::Presence& mine, const pdu::Presence& theirs) noexcept {
  return std::tie(mine.started, mine.epoch) < std::tie(theirs.started, theirs.epoch);
}

bool is_leaving(const pdu::Presence& heard) noexcept {
  return (heard.flags & pdu::kPresenceLeaving) != 0;
}

}  // namespace

Presence::Presence(const PresenceConfig& config, const pdu::Presence& own)
    : config_(config), own_(own) {
  if (config.heartbeat.count() <= 0 || config.missed < 1) {
    throw std::invalid_argument("presence: heartbeat and number of misses must be positive");
  }
  if (own.epoch == 0) throw std::invalid_argument("presence: epoch 0; draw one at random");
  own_.flags = static_cast<std::uint16_t>(own_.flags & ~unsigned{pdu::kPresenceLeaving});
  peers_.reserve(config.capacity);
  epochs_.reserve(config.capacity);
  former_.reserve(kFormerLives);
  outgoing_.reserve(8);
  farewells_.reserve(8);
  events_.reserve(2 * config.capacity + 16);
  taken_.reserve(2 * config.capacity + 16);
}

void Presence::start(std::chrono::nanoseconds now) {
  running_ = true;
  next_ = now;
}

void Presence::stop() {
  if (!running_) return;
  running_ = false;
  farewells_.push_back(own_);
}

std::chrono::nanoseconds Presence::patience() const noexcept {
  return config_.missed * config_.heartbeat + config_.minimum_gap;
}

// Index of a peer; peers_.size() where it is not known.
std::size_t Presence::find(PeerId id) const noexcept {
  const auto found = std::find_if(peers_.begin(), peers_.end(),
                                  [id](const Peer& peer) { return peer.id() == id; });
  return static_cast<std::size_t>(found - peers_.begin());
}

bool Presence::is_former(std::uint32_t epoch) const noexcept {
  return std::any_of(former_.begin(), former_.end(),
                     [epoch](const FormerLife& life) { return life.epoch == epoch; });
}

bool Presence::shares_scene(const pdu::Presence& heard) const noexcept {
  const auto key = [](const pdu::Presence& one) {
    return std::tie(one.scene_hash, one.cell_scheme, one.cell_size, one.pool_size, one.port);
  };
  return key(heard) == key(own_);
}

void Presence::announce_soon(std::chrono::nanoseconds now) noexcept {
  if (!running_) return;
  const auto earliest = last_ ? std::max(now, *last_ + config_.minimum_gap) : now;
  next_ = std::min(next_, earliest);
}

void Presence::receive(const pdu::Presence& heard, std::chrono::nanoseconds now,
                       const SourceAddress& from) {
  if (heard.header.exercise_id != own_.header.exercise_id) return;
  if (heard.epoch == own_.epoch) return;  // our echo, maybe under an id given up
  ++counts_.heard;
  if (heard.simulation == own_.simulation) {
    if (!is_leaving(heard)) settle_conflict(heard, now, from);
    return;
  }
  const std::size_t known = find(heard.simulation);
  if (known < peers_.size()) {
    update(known, heard, now, from);
  } else if (!is_leaving(heard)) {
    welcome(heard, now, from);
  }
}

void Presence::settle_conflict(const pdu::Presence& heard, std::chrono::nanoseconds now,
                               const SourceAddress& from) {
  ++counts_.conflicts;
  if (!keeps_id(own_, heard)) {
    const PeerId former = own_.simulation;
    if (running_) farewells_.push_back(own_);
    own_.simulation = next_free();
    last_.reset();  // nobody has heard this identity: no gap to keep
    events_.push_back({PresenceEventKind::identity_changed, own_, former, 0});
    welcome(heard, now, from);
  }
  announce_soon(now);
}

PeerId Presence::next_free() const noexcept {
  PeerId id = own_.simulation;
  for (std::size_t tries = 0; tries <= peers_.size() + 2; ++tries) {
    ++id.application;
    if (id.application == 0 || id.application == 0xFFFF) id.application = 1;  // these are reserved
    if (find(id) == peers_.size()) break;
  }
  return id;
}

void Presence::welcome(const pdu::Presence& heard, std::chrono::nanoseconds now,
                       const SourceAddress& from) {
  if (peers_.size() == config_.capacity) {
    ++counts_.table_full;
    return;
  }
  const bool joined = shares_scene(heard);
  peers_.push_back({heard, now, now, joined, from});
  epochs_.push_back(heard.epoch);
  events_.push_back(
      {joined ? PresenceEventKind::newcomer : PresenceEventKind::scene_mismatch, heard, {}, 0});
  announce_soon(now);
}

void Presence::update(std::size_t index, const pdu::Presence& heard, std::chrono::nanoseconds now,
                      const SourceAddress& from) {
  Peer& peer = peers_[index];
  if (heard.epoch != peer.announced.epoch) {
    if (is_former(heard.epoch)) {
      ++counts_.former_life;
    } else if (!is_leaving(heard)) {
      begin_life(index, heard, now, from);
    }
    return;
  }
  if (is_leaving(heard)) {
    remove(index, PresenceEventKind::departed);
    return;
  }
  const bool joined = shares_scene(heard);
  if (joined != peer.joined) {
    events_.push_back(
        {joined ? PresenceEventKind::newcomer : PresenceEventKind::scene_mismatch, heard, {}, 0});
  }
  peer.announced = heard;
  peer.last_heard = now;
  peer.joined = joined;
  peer.source = from;
}

void Presence::begin_life(std::size_t index, const pdu::Presence& heard,
                          std::chrono::nanoseconds now, const SourceAddress& from) {
  const std::uint32_t over = peers_[index].announced.epoch;
  bury(heard.simulation, over);
  const bool joined = shares_scene(heard);
  peers_[index] = {heard, now, now, joined, from};
  epochs_[index] = heard.epoch;
  events_.push_back(
      {joined ? PresenceEventKind::restarted : PresenceEventKind::scene_mismatch, heard, {}, over});
  announce_soon(now);
}

void Presence::bury(PeerId id, std::uint32_t epoch) {
  if (former_.size() == kFormerLives) former_.erase(former_.begin());
  former_.push_back({id, epoch});
}

void Presence::remove(std::size_t index, PresenceEventKind why) {
  const PeerId id = peers_[index].id();
  events_.push_back({why, peers_[index].announced, {}, 0});

  // The id is free again: who disputed it with the one that left may be heard under it now.
  std::erase_if(former_, [id](const FormerLife& life) { return life.id == id; });
  peers_[index] = peers_.back();
  epochs_[index] = epochs_.back();
  peers_.pop_back();
  epochs_.pop_back();
}

std::span<const pdu::Presence> Presence::step(std::chrono::nanoseconds now) {
  for (std::size_t i = peers_.size(); i-- > 0;) {
    if (now - peers_[i].last_heard > patience()) remove(i, PresenceEventKind::timed_out);
  }
  std::swap(outgoing_, farewells_);
  farewells_.clear();
  for (pdu::Presence& farewell : outgoing_) farewell.flags |= pdu::kPresenceLeaving;

  if (is_due(now)) {
    outgoing_.push_back(own_);
    last_ = now;
    next_ = now + config_.heartbeat;
  }
  counts_.announced += outgoing_.size();
  return outgoing_;
}

std::span<const PresenceEvent> Presence::take_events() {
  taken_.clear();
  std::swap(taken_, events_);
  return taken_;
}

Standing Presence::standing(std::uint32_t epoch) const noexcept {
  if (epoch == own_.epoch) return Standing::own;
  const auto found = std::find(epochs_.begin(), epochs_.end(), epoch);
  if (found != epochs_.end()) {
    const Peer& peer = peers_[static_cast<std::size_t>(found - epochs_.begin())];
    return peer.joined ? Standing::member : Standing::other_scene;
  }
  return is_former(epoch) ? Standing::former_life : Standing::unknown;
}

std::optional<std::uint32_t> Presence::epoch_of(PeerId id) const noexcept {
  const std::size_t known = find(id);
  if (known == peers_.size() || !peers_[known].joined) return {};
  return epochs_[known];
}

std::optional<SourceAddress> Presence::source_of(std::uint32_t epoch) const noexcept {
  const auto found = std::find(epochs_.begin(), epochs_.end(), epoch);
  if (found == epochs_.end()) return {};
  return peers_[static_cast<std::size_t>(found - epochs_.begin())].source;
}

void Presence::note_alive(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept {
  const auto found = std::find(epochs_.begin(), epochs_.end(), epoch);
  if (found == epochs_.end()) return;
  Peer& peer = peers_[static_cast<std::size_t>(found - epochs_.begin())];
  peer.last_heard = std::max(peer.last_heard, now);
}

std::chrono::nanoseconds Presence::next_step() const noexcept {
  if (!farewells_.empty()) return std::chrono::nanoseconds::min();
  std::chrono::nanoseconds next = running_ ? next_ : std::chrono::nanoseconds::max();
  for (const Peer& peer : peers_) {
    next = std::min(next, peer.last_heard + patience() + std::chrono::nanoseconds(1));
  }
  return next;
}

}  // namespace reckon::aoim
