// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/listener.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/entity/entity_state_update.hpp"
#include "reckon/pdu/management/entity_request.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tools/datagrams/survey.hpp"
#include "reckon/tools/listener/origin_at.hpp"

namespace reckon::tools {
namespace {

using deadreckon::ConversionError;
using pdu::DecodeError;
using std::chrono::nanoseconds;
using Timing = ListenerRules::Timing;
using Frame = ListenerRules::Frame;

/// Limit of entities of one datagram whose earlier state is kept; a bundle below the MTU holds
/// fewer.
constexpr std::size_t kMostTouched = 128;
/// Initial capacity of the index; it grows with the entities.
constexpr std::size_t kFirstKeys = 512;

/// Copies a PDU's fixed part, and makes it a complete PDU.
void keep_fixed(std::span<const std::byte> pdu, FixedOctets& out) {
  std::memcpy(out.data(), pdu.data(), out.size());
  out[8] = std::byte{0};
  out[9] = std::byte{kFixedOctets};
  out[19] = std::byte{0};
}

bool stands_still(const pdu::EntityState& pdu) {
  const pdu::Vector3Float& v = pdu.linear_velocity;
  return v.x == 0 && v.y == 0 && v.z == 0;
}

bool is_deactivated(const pdu::EntityState& pdu) {
  return (pdu.appearance & pdu::kAppearanceDeactivated) != 0;
}

/// Moves the last row to the free place.
template <typename Row>
void drop_row(std::vector<Row>& rows, std::size_t place) {
  if (rows.empty()) return;
  if (place + 1 != rows.size()) rows[place] = std::move(rows.back());
  rows.pop_back();
}

}  // namespace

Listener::Listener(const ListenerRules& rules)
    : rules_(rules), index_(std::min(rules.most_entities, kFirstKeys)), keys_(rules.most_entities) {
  if (rules_.frame == Frame::equator) frame_ = deadreckon::LocalFrame(0, 0, 0);
  if (rules_.by_datagram) touched_.reserve(kMostTouched);
}

// Known entities
// ------------------------------------------------------------------------------------------------

std::uint64_t Listener::key_of(std::uint8_t exercise, const pdu::EntityId& id) const noexcept {
  return entity_key(rules_.by_exercise ? exercise : std::uint8_t{0}, id);
}

std::size_t Listener::place_of_key(std::uint64_t key) const noexcept {
  const std::uint32_t place = index_.find(key);
  return place == peer::KeyIndex::kNone ? kNone : place;
}

std::size_t Listener::place_of(std::uint8_t exercise, const pdu::EntityId& id) const noexcept {
  return place_of_key(key_of(exercise, id));
}

// The place of an entity, known or new; kNone if there is no room.
std::size_t Listener::admit(std::uint8_t exercise, const pdu::EntityId& id) {
  const std::uint64_t key = key_of(exercise, id);
  if (const std::size_t known = place_of_key(key); known != kNone) return known;
  if (entities_.size() >= rules_.most_entities) {
    ++refusals_.crowded;
    return kNone;
  }
  const std::size_t place = entities_.size();
  ReceivedEntity& entity = entities_.emplace_back();
  entity.key = key;
  entity.id = id;
  entity.exercise = exercise;
  if (rules_.timing != Timing::pace) clocks_.emplace_back();
  index_.put(key, place);
  return place;
}

void Listener::forget_entity(std::size_t place) {
  const std::uint64_t key = entities_[place].key;
  std::erase_if(touched_, [&](const TouchedEntity& touched) { return touched.key == key; });
  drop_entity(place);
}

void Listener::drop_entity(std::size_t place) {
  if (entities_[place].is_haptic()) drop_model(entities_[place].model);
  index_.erase(entities_[place].key);
  drop_row(entities_, place);
  drop_row(clocks_, place);
  if (place == entities_.size()) return;
  index_.put(entities_[place].key, place);
  if (entities_[place].is_haptic()) models_[entities_[place].model].owner = place;
}

void Listener::drop_model(std::size_t place) {
  entities_[models_[place].owner].model = ReceivedEntity::kNoModel;
  drop_row(models_, place);
  if (place < models_.size()) entities_[models_[place].owner].model = place;
}

void Listener::forget_silent(nanoseconds time) {
  // The last entity moves to the free place, so this place is checked again.
  for (std::size_t i = 0; i < entities_.size();) {
    if (entities_[i].is_silent(time))
      forget_entity(i);
    else
      ++i;
  }
}

TouchedEntity& Listener::touch(std::uint8_t exercise, const pdu::EntityId& id) {
  const std::uint64_t key = key_of(exercise, id);
  const auto known = std::ranges::find(touched_, key, &TouchedEntity::key);
  if (known != touched_.end()) return *known;
  // When full, the last place is reused: only the earlier state of its entity is lost.
  if (touched_.size() == kMostTouched) touched_.pop_back();
  TouchedEntity& touched = touched_.emplace_back();
  touched.key = key;
  touched.id = id;
  const std::size_t place = place_of_key(key);
  if (place == kNone) return touched;
  touched.known = true;
  touched.before = entities_[place];
  if (const ReceivedModel* model = model_of(entities_[place])) touched.model_before = *model;
  return touched;
}

// States
// ------------------------------------------------------------------------------------------------

void Listener::take_pdu(Bytes pdu, const pdu::PduHeader& header, nanoseconds arrival) {
  ListenerObserver nobody;
  take_pdu(pdu, header, arrival, nobody);
}

std::size_t Listener::take_unreadable(std::uint8_t exercise, const pdu::EntityId& id,
                                      nanoseconds arrival) {
  if (!rules_.keeps) return kNone;
  const std::size_t place = admit(exercise, id);
  if (place != kNone && !entities_[place].has_state) entities_[place].arrival = arrival;
  return place;
}

bool Listener::read_state(Bytes pdu, const pdu::PduHeader& header, const pdu::EntityState* decoded,
                          StateUpdate& update) {
  if (header.pdu_type != pdu::PduType::entity_state) return read_partial(pdu, header, update);
  if (decoded == nullptr && decode(pdu, read_) != DecodeError::none) return false;
  update.pdu = decoded == nullptr ? &read_ : decoded;
  keep_fixed(pdu, update.octets);
  return true;
}

// An Entity State Update is the last Entity State with some fields changed.
bool Listener::read_partial(Bytes pdu, const pdu::PduHeader& header, StateUpdate& update) {
  pdu::EntityStateUpdate partial;
  if (!rules_.partial || decode(pdu, partial) != DecodeError::none) return false;
  const std::size_t place = place_of(header.exercise_id, partial.entity_id);
  if (place == kNone || !entities_[place].has_state) return false;
  read_ = entities_[place].entity_state();
  read_.header.timestamp = header.timestamp;
  read_.linear_velocity = partial.entity_linear_velocity;
  read_.location = partial.entity_location;
  read_.orientation = partial.entity_orientation;
  read_.appearance = partial.entity_appearance;
  update.pdu = &read_;
  return encode(read_, update.octets) == update.octets.size();
}

// Restores into read_ and restored_. @return false if its key is missing, or it cannot be read
bool Listener::restore(const pdu::CompressedStates& states, const pdu::CompressedState& state) {
  const auto verdict = keys_.restore(states, state, read_);
  return verdict == peer::RestoreVerdict::good && encode(read_, restored_) == restored_.size();
}

// Finds the entity and checks the state. @return false if the rules ignore such an entity
bool Listener::place_state(StateUpdate& update) {
  const pdu::PduHeader& header = update.pdu->header;
  const pdu::EntityId& id = update.pdu->entity_id;
  const std::size_t known = place_of(header.exercise_id, id);
  if (is_deactivated(*update.pdu) && !rules_.keeps) {
    if (known != kNone) forget_entity(known);
    return false;
  }
  if (known == kNone && !rules_.uncoupled && !header.coupled_extension()) return false;
  if (rules_.sweeps) forget_silent(update.arrival);
  TouchedEntity* touched = rules_.by_datagram ? &touch(header.exercise_id, id) : nullptr;
  update.place = known != kNone && !rules_.sweeps ? known : admit(header.exercise_id, id);
  if (update.place != kNone) judge(update);
  if (touched != nullptr)
    touched->refused = update.place == kNone || update.verdict != ReceiveVerdict::taken;
  return update.place != kNone;
}

void Listener::judge(StateUpdate& update) {
  const ReceivedEntity& entity = entities_[update.place];
  update.error = convert(*update.pdu, update.state);
  update.verdict =
      update.error != ConversionError::none ? ReceiveVerdict::values : lay_on_time(update);
  const bool rests = rules_.rests && stands_still(*update.pdu);
  update.heartbeat = entity.is_haptic()
                         ? deadreckon::kHapticHeartbeat
                         : deadreckon::nominal_heartbeat(update.pdu->entity_type, rests);
}

ConversionError Listener::convert(const pdu::EntityState& pdu, deadreckon::KinematicState& out) {
  const Eigen::Vector3d position(pdu.location.x, pdu.location.y, pdu.location.z);
  if (rules_.frame == Frame::first_place && !frame_.has_value() && position.allFinite() &&
      position.norm() <= deadreckon::kLargestLocation)
    frame_ = local_frame_at(position);
  return frame_.has_value() ? from_wire(pdu, *frame_, out) : from_wire(pdu, out);
}

ReceiveVerdict Listener::lay_on_time(StateUpdate& update) {
  const ReceivedEntity& entity = entities_[update.place];
  const std::uint32_t timestamp = update.pdu->header.timestamp;
  if (rules_.timing == Timing::pace) {
    update.state_time = update.arrival;
    update.is_first = !entity.has_state || entity.gone || entity.is_silent(update.arrival);
    if (update.is_first) return ReceiveVerdict::taken;
    update.between = entity.pace.interval(entity.octets, update.octets, entity.age(update.arrival));
    update.is_first = update.between.set_back;
    if (update.between.late) return ReceiveVerdict::stale;
    return update.between.duplicate ? ReceiveVerdict::duplicate : ReceiveVerdict::taken;
  }
  const auto stamped = clocks_[update.place].local_time(timestamp, update.arrival, update.arrival);
  const bool any = rules_.timing == Timing::sender_clock_or_arrival;
  const bool runs = !any || entity.updates == 0 ||
                    pdu::difference_units(timestamp, timestamp_of(entity.octets)) > 0;
  update.state_time = runs ? stamped.value_or(update.arrival) : update.arrival;
  return stamped.has_value() || any ? ReceiveVerdict::taken : ReceiveVerdict::stale;
}

void Listener::settle(const StateUpdate& update) {
  ReceivedEntity& entity = entities_[update.place];
  if (update.verdict == ReceiveVerdict::taken) {
    return adopt(entity, update);
  }
  if (update.verdict == ReceiveVerdict::values) ++refusals_.values;
  if (update.verdict == ReceiveVerdict::stale) {
    ++refusals_.stale;
    entity.pace.note_late();
  }
  if (entity.has_state) return;
  entity.arrival = update.arrival;
  if (!rules_.keeps) drop_entity(update.place);
}

// Makes the state the entity's newest.
void Listener::adopt(ReceivedEntity& entity, const StateUpdate& update) const {
  if (update.is_first)
    entity.pace.restart();
  else
    entity.pace.advance(entity.octets, update.octets, entity.age(update.arrival));
  entity.has_state = true;
  ++entity.updates;
  entity.octets = update.octets;
  entity.state = update.state;
  entity.state_time = update.state_time;
  entity.arrival = update.arrival;
  entity.gone = is_deactivated(*update.pdu);
  if (entity.gone) entity.gone_at = update.arrival;
  set_heartbeat(entity, update.heartbeat);
}

void Listener::set_heartbeat(ReceivedEntity& entity, double heartbeat) const noexcept {
  entity.heartbeat = heartbeat;
  if (rules_.holds) entity.hold_after = deadreckon::timeout(heartbeat);
}

void Listener::take_removal(Bytes pdu, const pdu::PduHeader& header, nanoseconds arrival) {
  const auto remove = [&](const pdu::EntityId& id) {
    const std::size_t place = place_of(header.exercise_id, id);
    if (place == kNone) return;
    entities_[place].gone = true;
    entities_[place].gone_at = arrival;
  };
  pdu::RemoveEntity plain;
  pdu::RemoveEntityR reliable;
  if (header.pdu_type == pdu::PduType::remove_entity && decode(pdu, plain) == DecodeError::none)
    remove(plain.receiving_entity_id);
  if (header.pdu_type == pdu::PduType::remove_entity_r &&
      decode(pdu, reliable) == DecodeError::none)
    remove(reliable.receiving_entity_id);
}

// Records
// ------------------------------------------------------------------------------------------------

bool Listener::read_model(const pdu::PduHeader& header, const pdu::EntityId& id,
                          const pdu::HapticRecord& record, ModelUpdate& update) {
  if (rules_.by_datagram && touch(header.exercise_id, id).refused) return false;
  update.place = place_of(header.exercise_id, id);
  if (update.place == kNone || !entities_[update.place].has_state) {
    ++refusals_.unplaced;
    return false;
  }
  if (deadreckon::from_wire(record, update.model) == ConversionError::none) return true;
  ++refusals_.values;
  return false;
}

void Listener::adopt(const ModelUpdate& update) {
  ReceivedEntity& entity = entities_[update.place];
  if (!entity.is_haptic()) {
    entity.model = models_.size();
    models_.emplace_back();
  }
  models_[entity.model] = {update.place, update.model, entity.arrival};
  set_heartbeat(entity, deadreckon::kHapticHeartbeat);
}

Listener::AccountKey Listener::key(const pdu::EntityId& from, const pdu::EntityId& to) noexcept {
  return {from.site, from.application, from.entity, to.site, to.application, to.entity};
}

void Listener::take_account(const pdu::EntityId& id, const pdu::EnergyAccountRecord& record) {
  const StatedEnergy stated{record.given, pdu::from_microjoules(record.need)};
  if (!std::isfinite(stated.given) || !std::isfinite(stated.need)) {
    ++refusals_.values;
    return;
  }
  const auto place = accounts_.find(key(id, record.counterpart));
  if (place != accounts_.end())
    place->second = stated;
  else if (accounts_.size() < kMostAccounts)
    accounts_.emplace(key(id, record.counterpart), stated);
  else
    ++refusals_.crowded;
}

StatedEnergy Listener::stated_energy(const pdu::EntityId& from,
                                     const pdu::EntityId& to) const noexcept {
  const auto place = accounts_.find(key(from, to));
  return place == accounts_.end() ? StatedEnergy{} : place->second;
}

StatedEnergy Listener::stated_energy(const pdu::EntityId& from) const noexcept {
  StatedEnergy sum;
  for (auto place = accounts_.lower_bound(key(from, {0, 0, 0}));
       place != accounts_.end() && place->first <= key(from, {0xFFFF, 0xFFFF, 0xFFFF}); ++place) {
    sum.given += place->second.given;
    sum.need += place->second.need;
  }
  return sum;
}

}  // namespace reckon::tools
