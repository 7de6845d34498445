// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/simulated_peer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {
namespace {

using aoim::IncomingVerdict;
using aoim::PresenceEventKind;
using std::chrono::milliseconds;

constexpr nanoseconds kLookPeriod = milliseconds(50);
constexpr nanoseconds kLongestWait = milliseconds(100);
constexpr nanoseconds kIntroductionPeriod = milliseconds(10);
constexpr double kSweep = 200.0, kJump = 110.0;  // [m]
constexpr nanoseconds kChatterPeriod = milliseconds(2), kChatter = std::chrono::seconds(1);
constexpr std::uint64_t kSceneHash = 0x5CE7E;

// A stand-in for a one-way function: no forger here inverts it.
aoim::ChainLink followed(const aoim::ChainLink& link, std::uint32_t number) noexcept {
  aoim::ChainLink value{};
  std::uint64_t state = mixed(0x0C4A1, number, 0);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      state = mixed(state, link[i], value[i]);
      value[i] = static_cast<std::uint8_t>(state >> 56);
    }
  }
  return value;
}

aoim::AreaOfInterestConfig config_of(const Plan& plan, std::uint32_t epoch) {
  aoim::AreaOfInterestConfig config;
  config.grid.cell_size = 50.0;
  config.grid.pool = plan.wide ? 12 : 1;
  config.presence.capacity = table_size(plan.hosts.size());
  config.tracked = kTracked;
  config.presence.one_way = followed;
  config.presence.secret = followed({}, epoch);
  return config;
}

pdu::Presence presence_of(const Plan& plan, std::size_t host, std::uint32_t epoch,
                          nanoseconds utc) {
  pdu::Presence own;
  own.simulation = plan.hosts[host].wanted;
  own.epoch = epoch;
  own.started = static_cast<std::uint32_t>(utc / std::chrono::seconds(1));
  own.scene_hash = kSceneHash;
  own.interest_radius = static_cast<float>(kRadius);
  return own;
}

// Back and forth over the sweep.
double swept(double way) noexcept {
  const double turn = std::fmod(way, 2 * kSweep);
  return turn < kSweep ? turn : 2 * kSweep - turn;
}

}  // namespace

aoim::Position OwnEntity::at(nanoseconds now) const noexcept {
  const double jump = now < jump_at ? 0.0 : home.y < kSweep / 2 ? kJump : -kJump;
  return {home.x + swept(speed * pdu::to_seconds(now)), home.y + jump, 0.0};
}

SimulatedPeer::SimulatedPeer(const Plan& plan, std::size_t host, std::uint32_t epoch,
                             nanoseconds now, nanoseconds clock)
    : wide_(plan.wide),
      moves_(plan.hosts[host].moves),
      aoim_(config_of(plan, epoch), presence_of(plan, host, epoch, now + clock)),
      id_(aoim_.presence().id()) {
  Dice dice(mixed(plan.seed, 5, host));
  for (std::size_t i = 0; i < plan.hosts[host].entities; ++i) {
    OwnEntity entity;
    entity.number = static_cast<std::uint16_t>(i + 1);
    const double extent = wide_ ? kSweep : kRadius / 2;
    entity.home = {extent * dice.unit(), extent * dice.unit(), 0.0};
    entity.speed = moves_ ? 5.0 + 25.0 * dice.unit() : 0.0;
    if (host == plan.jumper) entity.jump_at = plan.jump_at;
    entities_.push_back(entity);
  }
  if (host == plan.chatterer) chatter_at_ = plan.chatter_at;
  aoim_.introductions().set_owned(entities_.size());
  set_clock(clock);
  look_around(now);
  aoim_.start(now);
}

void SimulatedPeer::set_clock(nanoseconds clock) noexcept { aoim_.set_utc_offset(clock, true); }

aoim::Incoming SimulatedPeer::receive(aoim::GroupIndex group, std::span<const std::byte> datagram,
                                      nanoseconds now, const aoim::SourceAddress& from) {
  const std::uint64_t noted = aoim_.sequences().counts().received;
  const aoim::Incoming incoming = aoim_.receive(group, datagram, now, from);
  // Sequence numbers of a sender without an announcement belong to no peer.
  misjudged_ = false;
  if (aoim_.sequences().counts().received != noted) note_truth(group, incoming);
  const std::uint32_t epoch = incoming.trailer.epoch;
  if (incoming.verdict == IncomingVerdict::use) take_entities(datagram, epoch, now);
  deliver_events(aoim_, *this, now);
  return incoming;
}

void SimulatedPeer::note_truth(aoim::GroupIndex group, const aoim::Incoming& incoming) {
  const IncomingVerdict verdict = incoming.verdict;
  const bool counts = verdict == IncomingVerdict::use || verdict == IncomingVerdict::stranger ||
                      verdict == IncomingVerdict::duplicate || verdict == IncomingVerdict::too_old;
  if (!counts) return;
  const auto right = truth_.note(incoming.trailer.epoch, group, incoming.trailer.sequence);
  const auto deserved = right == aoim::SequenceVerdict::duplicate ? IncomingVerdict::duplicate
                        : right == aoim::SequenceVerdict::too_old ? IncomingVerdict::too_old
                                                                  : IncomingVerdict::use;
  misjudged_ = deserved != (verdict == IncomingVerdict::stranger ? IncomingVerdict::use : verdict);
}

// Only the owner of an entity may send its state; an echo of an old name is ignored.
void SimulatedPeer::take_entities(std::span<const std::byte> datagram, std::uint32_t epoch,
                                  nanoseconds now) {
  const aoim::Peer* sender = find(epoch);
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::EntityState state;
    if (bundled.error != pdu::DecodeError::none ||
        bundled.header.pdu_type != pdu::PduType::entity_state ||
        pdu::decode(bundled.bytes, state) != pdu::DecodeError::none) {
      continue;
    }
    if (sender == nullptr || sender->id() != state.entity_id.simulation()) continue;
    if (aoim_.presence().is_own(state.entity_id)) continue;
    const auto row = std::find_if(shown_.begin(), shown_.end(), [&](const ShownEntity& shown) {
      return shown.id == state.entity_id;
    });
    const auto& place = state.location;
    const bool accepted = aoim::is_accepted(
        aoim_.sight().judge({place.x, place.y, place.z}, 0.0, 1, row != shown_.end()));
    if (!accepted && row != shown_.end()) shown_.erase(row);
    if (!accepted) continue;
    if (row != shown_.end()) {
      *row = {state.entity_id, epoch, now};
    } else {
      shown_.push_back({state.entity_id, epoch, now});
    }
  }
}

// The owner of an entity follows from the table of peers.
void SimulatedPeer::claim(const aoim::PeerId&, std::uint32_t) noexcept {}

void SimulatedPeer::drop(const aoim::PresenceEvent::Dropped& life, bool) noexcept {
  std::erase_if(shown_,
                [&](const ShownEntity& shown) { return shown.id.simulation() == life.name; });
}

// No cell has a leader.
void SimulatedPeer::receive(const aoim::RelayedState&, const aoim::SourceAddress&) noexcept {}

void SimulatedPeer::report(const aoim::PresenceEvent& event) noexcept {
  switch (event.kind) {
    case PresenceEventKind::restarted:
      truth_.forget(event.former_epoch);
      break;
    case PresenceEventKind::moved:
    case PresenceEventKind::departed:
    case PresenceEventKind::timed_out:
      truth_.forget(event.announced.epoch);
      break;
    default:
      break;
  }
  events_.push_back(event);
}

std::vector<aoim::PresenceEvent> SimulatedPeer::take_events() {
  std::vector<aoim::PresenceEvent> taken;
  std::swap(taken, events_);
  return taken;
}

void SimulatedPeer::look_around(nanoseconds now) {
  foci_.clear();
  for (const OwnEntity& entity : entities_) {
    foci_.push_back({entity.at(now), entity.speed, kRadius});
  }
  const aoim::SubscriptionChange change = aoim_.listen(aoim::kCellTier, foci_, now);
  for (const aoim::GroupIndex group : change.leave) truth_.forget(group);
  for (const aoim::GroupIndex group : change.join) {
    truth_.forget(group);
    joined_[group.value] = now;
  }
  next_look_ = now + kLookPeriod;
  std::erase_if(shown_,
                [&](const ShownEntity& shown) { return now - shown.heard > kEntityTimeout; });
}

void SimulatedPeer::send_due(nanoseconds now) {
  for (OwnEntity& entity : entities_) {
    const pdu::EntityId id{this->id().site, this->id().application, entity.number};
    const bool due =
        now >= entity.next_heartbeat || aoim_.must_send(aoim::kCellTier, id, entity.at(now),
                                                        {entity.last_sent, entity.last_group}, now);
    if (due) send(entity, now);
  }
}

void SimulatedPeer::send(OwnEntity& entity, nanoseconds now) {
  pdu::EntityState state;
  state.entity_id = {id().site, id().application, entity.number};
  const aoim::Position place = entity.at(now);
  state.location = {place.x, place.y, place.z};
  static_cast<void>(aoim_.send(aoim::kCellTier, aoim::StatePayload{state}, place, now));
  entity.last_sent = now;
  entity.last_group = aoim_.route(place);
  entity.next_heartbeat = next_heartbeat(entity, now);
}

nanoseconds SimulatedPeer::next_heartbeat(const OwnEntity& entity, nanoseconds now) const noexcept {
  const nanoseconds next =
      now + (entity.speed > 0 ? nanoseconds(milliseconds(500)) : kEntityHeartbeat);
  if (now < chatter_at_) return std::min(next, chatter_at_);
  return now - chatter_at_ < kChatter ? now + kChatterPeriod : next;
}

void SimulatedPeer::step(nanoseconds now, aoim::DatagramSink sink) {
  if (now >= next_look_) look_around(now);
  send_due(now);
  aoim_.step(now, sink);
  deliver_events(aoim_, *this, now);
}

void SimulatedPeer::leave(nanoseconds now, aoim::DatagramSink sink) {
  aoim_.stop();
  aoim_.step(now, sink);
  aoim_.flush(now, sink);
  deliver_events(aoim_, *this, now);
}

nanoseconds SimulatedPeer::next(nanoseconds now) const noexcept {
  nanoseconds next = std::min(aoim_.next_step(), now + kLongestWait);
  if (moves_) next = std::min(next, next_look_);
  if (aoim_.introductions().is_pending()) next = std::min(next, now + kIntroductionPeriod);
  for (const OwnEntity& entity : entities_) next = std::min(next, entity.next_heartbeat);
  return std::max(next, now);
}

const aoim::Peer* SimulatedPeer::find(std::uint32_t epoch) const noexcept {
  for (const aoim::Peer& peer : aoim_.presence().peers()) {
    if (peer.announced.epoch == epoch) return &peer;
  }
  return nullptr;
}

bool SimulatedPeer::shows(const pdu::EntityId& id, std::uint32_t epoch) const noexcept {
  return std::any_of(shown_.begin(), shown_.end(), [&](const ShownEntity& shown) {
    return shown.id == id && shown.epoch == epoch;
  });
}

double SimulatedPeer::distance_to(const aoim::Position& position, nanoseconds now) const noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  for (const OwnEntity& entity : entities_) {
    nearest = std::min(nearest, aoim::distance(entity.at(now), position));
  }
  return nearest;
}

}  // namespace reckon::fuzz
