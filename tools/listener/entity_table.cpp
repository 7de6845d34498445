// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/entity_table.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/entity/entity_state_update.hpp"
#include "reckon/pdu/management/entity_request.hpp"
#include "reckon/tools/datagrams/survey.hpp"

namespace reckon::tools {
namespace {

using deadreckon::ConversionError;
using std::chrono::nanoseconds;

constexpr nanoseconds kRateWindow = std::chrono::seconds(5);
constexpr std::uint64_t kRateUpdates = 4;

double seconds(nanoseconds time) { return std::chrono::duration<double>(time).count(); }

/// A PDU's fixed part as a whole PDU.
void keep_fixed(std::span<const std::byte> pdu, FixedOctets& out) {
  std::memcpy(out.data(), pdu.data(), out.size());
  out[8] = std::byte{0};
  out[9] = std::byte{kFixedOctets};
  out[19] = std::byte{0};
}

void move_window(EntityRow& entity) {
  if (entity.updates - entity.window_updates[1] < kRateUpdates ||
      entity.last.arrival - entity.window_time[1] < kRateWindow)
    return;
  entity.window_time = {entity.window_time[1], entity.last.arrival};
  entity.window_updates = {entity.window_updates[1], entity.updates};
}

// Nothing can be compared with what was before.
void begin_anew(EntityRow& entity, nanoseconds arrival) {
  entity.last.told_time = entity.last.arrival_time = 0;
  entity.window_time = {arrival, arrival};
  entity.window_updates = {entity.updates + 1, entity.updates + 1};
}

void note_bad(EntityRow& entity, const peer::SourceDatagram& datagram, std::string_view rule) {
  if (!entity.has_state) {
    entity.last.arrival = datagram.time;
    entity.sender = datagram.source;
    entity.group = datagram.group;
  }
  ++entity.bad;
  entity.rule = rule;
  entity.last_is_bad = true;
}

void set_cause(EntityRow& entity, UpdateCause cause) {
  entity.cause = cause;
  ++entity.causes[static_cast<std::size_t>(cause)];
}

double heartbeat_of(const EntityRow& entity, const pdu::EntityState& pdu) {
  if (entity.force != EntityRow::kNoForce) return deadreckon::kHapticHeartbeat;
  const pdu::Vector3Float& v = pdu.linear_velocity;
  return deadreckon::nominal_heartbeat(pdu.entity_type, v.x == 0 && v.y == 0 && v.z == 0);
}

constexpr std::size_t kFewestSlots = 1024;

}  // namespace

struct EntityTable::Update {
  const PduRow& row;
  const peer::SourceDatagram& datagram;
  const FixedOctets& octets;
  const pdu::EntityState& pdu;
  deadreckon::KinematicState state;
};

double EntityRow::age(nanoseconds now) const noexcept { return seconds(now - last.arrival); }

bool EntityRow::stale(nanoseconds now) const noexcept {
  return has_state && !gone && age(now) > deadreckon::timeout(last.heartbeat);
}

double EntityRow::rate(nanoseconds now) const noexcept {
  const auto count = static_cast<double>(updates - window_updates[0]);
  const double span = seconds(last.arrival - window_time[0]);
  if (count == 0 || span <= 0) return 0;
  return count / std::max(span, seconds(now - window_time[0]) - span / count);
}

std::vector<double> EntityRow::recent_jumps() const {
  const std::uint64_t end = jumps.count();
  std::vector<double> out;
  for (std::uint64_t i = end - std::min<std::uint64_t>(end, recent.size()); i < end; ++i)
    out.push_back(recent[i % recent.size()]);
  return out;
}

pdu::EntityState EntityRow::entity_state() const noexcept {
  pdu::EntityState pdu;
  if (has_state) (void)decode(last.octets, pdu);
  return pdu;
}

EntityTable::EntityTable(std::size_t most_rows) : most_rows_(most_rows), slots_(kFewestSlots) {}

double EntityTable::seconds_of(nanoseconds time) const noexcept {
  return seconds(time - start_.value_or(time));
}

// The place of this entity, or the free one where it belongs.
std::size_t EntityTable::slot_of(std::uint64_t key) const noexcept {
  const std::size_t mask = slots_.size() - 1;
  // Fibonacci hashing: neighbouring numbers far apart.
  std::size_t slot = (key * 0x9E3779B97F4A7C15U) >> (64 - std::countr_zero(slots_.size()));
  while (slots_[slot] != 0 && rows_[slots_[slot] - 1].key != key) slot = (slot + 1) & mask;
  return slot;
}

void EntityTable::index_all() {
  std::fill(slots_.begin(), slots_.end(), 0U);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    slots_[slot_of(rows_[i].key)] = static_cast<std::uint32_t>(i + 1);
}

const EntityRow* EntityTable::find(std::uint64_t key) const noexcept {
  const std::uint32_t place = slots_[slot_of(key)];
  return place == 0 ? nullptr : &rows_[place - 1];
}

EntityRow* EntityTable::known(const PduRow& row, pdu::EntityId id) noexcept {
  const std::uint32_t place = slots_[slot_of(entity_key(row.header.exercise_id, id))];
  return place == 0 ? nullptr : &rows_[place - 1];
}

EntityRow* EntityTable::row_of(std::uint8_t exercise, pdu::EntityId id) {
  const std::uint64_t key = entity_key(exercise, id);
  const std::size_t slot = slot_of(key);
  if (slots_[slot] != 0) return &rows_[slots_[slot] - 1];
  if (rows_.size() >= most_rows_) return ++others_, nullptr;
  EntityRow& row = rows_.emplace_back();
  row.key = key;
  row.id = id;
  row.exercise = exercise;
  slots_[slot] = static_cast<std::uint32_t>(rows_.size());
  if (2 * rows_.size() > slots_.size()) {
    slots_.resize(2 * slots_.size());
    index_all();
  }
  return &row;
}

void EntityTable::take(const PduRow& row, const peer::SourceDatagram& datagram) {
  if (!start_.has_value()) start_ = datagram.time;
  if (!row.decoded) {
    if (row.status == PduStatus::error) take_broken(row, datagram);
    return;
  }
  switch (row.header.pdu_type) {
    case pdu::PduType::entity_state:
      return take_state(row, datagram);
    case pdu::PduType::entity_state_update:
      return take_state_update(row, datagram);
    case pdu::PduType::attribute:
      return take_records(row, datagram);
    case pdu::PduType::remove_entity:
    case pdu::PduType::remove_entity_r:
      return take_removal(row, datagram);
    default:
      return;
  }
}

// Entity States alone make an entity known, so broken ones do too.
void EntityTable::take_broken(const PduRow& row, const peer::SourceDatagram& datagram) {
  if (!row.id.has_value() || row.header.pdu_type != pdu::PduType::entity_state) return;
  EntityRow* entity = row_of(row.header.exercise_id, *row.id);
  if (entity == nullptr) return;
  entity->octets += row.bytes.size();
  note_bad(*entity, datagram, row.rule);
}

void EntityTable::take_state(const PduRow& row, const peer::SourceDatagram& datagram) {
  pdu::EntityState pdu;
  if (decode(row.bytes, pdu) != pdu::DecodeError::none) return;
  EntityRow* entity = row_of(row.header.exercise_id, pdu.entity_id);
  if (entity == nullptr) return;
  FixedOctets octets;
  keep_fixed(row.bytes, octets);
  take_state(*entity, {row, datagram, octets, pdu, {}});
}

void EntityTable::take_state(EntityRow& entity, Update update) {
  entity.octets += update.row.bytes.size();
  const ConversionError error = from_wire(update.pdu, update.state);
  if (error == ConversionError::none) return this->update(entity, update);
  note_bad(entity, update.datagram, update.row.rule.empty() ? sentence(error) : update.row.rule);
}

void EntityTable::take_state_update(const PduRow& row, const peer::SourceDatagram& datagram) {
  pdu::EntityStateUpdate partial;
  if (decode(row.bytes, partial) != pdu::DecodeError::none) return;
  EntityRow* entity = known(row, partial.entity_id);
  if (entity == nullptr || !entity->has_state) return;
  pdu::EntityState pdu = entity->entity_state();
  pdu.header.timestamp = row.header.timestamp;
  pdu.linear_velocity = partial.entity_linear_velocity;
  pdu.location = partial.entity_location;
  pdu.orientation = partial.entity_orientation;
  pdu.appearance = partial.entity_appearance;
  FixedOctets octets;
  if (encode(pdu, octets) == octets.size()) take_state(*entity, {row, datagram, octets, pdu, {}});
}

void EntityTable::update(EntityRow& entity, const Update& update) {
  const nanoseconds arrival = update.datagram.time;
  const bool known = entity.has_state && !entity.gone && !entity.stale(arrival);
  const Interval between =
      known ? interval(entity.last, update.octets, arrival) : Interval{.set_back = true};
  if (between.late || between.duplicate) {
    ++(between.late ? entity.late : entity.duplicated);
    if (between.late) ++entity.last.late_in_a_row;
    return;
  }
  entity.last.heartbeat = heartbeat_of(entity, update.pdu);
  UpdateCause cause = UpdateCause::first;
  if (between.set_back) {
    begin_anew(entity, arrival);
  } else {
    const Innovation found = innovation(entity.last.state, update.state, between);
    entity.jump = found.jump;
    entity.recent[entity.jumps.count() % entity.recent.size()] = static_cast<float>(found.jump);
    entity.jumps.add(found.jump);
    cause = cause_of(entity.last, found, between.seconds);
    if (is_event(entity.last.octets, update.octets)) cause = UpdateCause::event;
    entity.last.arrival_time += seconds(arrival - entity.last.arrival);
    entity.last.told_time += told_seconds(entity.last, update.octets);
  }
  set_cause(entity, cause);
  adopt(entity, update);
}

// Makes the update the entity's last one.
void EntityTable::adopt(EntityRow& entity, const Update& update) {
  ++entity.updates;
  entity.has_state = true;
  entity.last_is_bad = false;
  entity.last.late_in_a_row = 0;
  entity.last.state = update.state;
  entity.last.octets = update.octets;
  entity.last.arrival = update.datagram.time;
  entity.length = update.row.header.length;
  entity.frame = update.row.frame;
  entity.pdu_index = update.row.pdu;
  entity.sender = update.datagram.source;
  entity.group = update.datagram.group;
  entity.gone = (update.pdu.appearance & pdu::kAppearanceDeactivated) != 0;
  if (entity.gone) entity.gone_at = update.datagram.time;
  move_window(entity);
  if (entity.force != EntityRow::kNoForce)
    forces_.update_entity(entity.force, update.state, seconds_of(update.datagram.time));
}

void EntityTable::take_records(const PduRow& row, const peer::SourceDatagram& datagram) {
  pdu::Attribute attribute;
  if (decode(row.bytes, attribute) != pdu::DecodeError::none) return;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    EntityRow* entity = known(row, set.entity_id);
    if (entity == nullptr || !entity->has_state) continue;
    if (attribute.record_sets.count == 1) entity->octets += row.bytes.size();
    for (const pdu::AttributeRecord& record : set.records()) {
      pdu::HapticRecord haptic;
      if (record.type == pdu::HapticRecord::kType &&
          decode(record, haptic) == pdu::DecodeError::none)
        take_record(*entity, haptic, datagram.time);
    }
  }
}

void EntityTable::take_record(EntityRow& entity, const pdu::HapticRecord& record,
                              nanoseconds arrival) {
  if (entity.force == EntityRow::kNoForce) {
    entity.force = forces_.add();
    entity.last.heartbeat = deadreckon::kHapticHeartbeat;
  }
  const auto is_new =
      forces_.update_model(entity.force, record, entity.last.state, seconds_of(arrival));
  if (!is_new.value_or(false) || entity.last.arrival != arrival) return;
  // Weaker causes of the Entity State in front give way.
  if (entity.cause == UpdateCause::heartbeat || entity.cause == UpdateCause::repeat) {
    --entity.causes[static_cast<std::size_t>(entity.cause)];
    set_cause(entity, UpdateCause::force);
  }
}

void EntityTable::take_removal(const PduRow& row, const peer::SourceDatagram& datagram) {
  const auto remove = [&](pdu::EntityId id) {
    EntityRow* entity = known(row, id);
    if (entity == nullptr) return;
    entity->gone = true;
    entity->gone_at = datagram.time;
  };
  pdu::RemoveEntity plain;
  pdu::RemoveEntityR reliable;
  if (row.header.pdu_type == pdu::PduType::remove_entity) {
    if (decode(row.bytes, plain) == pdu::DecodeError::none) remove(plain.receiving_entity_id);
  } else if (decode(row.bytes, reliable) == pdu::DecodeError::none) {
    remove(reliable.receiving_entity_id);
  }
}

void EntityTable::drop_gone(nanoseconds now) {
  const auto is_over = [&](const EntityRow& row) {
    return row.gone && now - row.gone_at > kGoneShown;
  };
  if (std::erase_if(rows_, is_over) == 0) return;
  std::vector<std::size_t> kept;
  for (EntityRow& row : rows_) {
    if (row.force == EntityRow::kNoForce) continue;
    kept.push_back(row.force);
    row.force = kept.size() - 1;
  }
  forces_.keep(kept);
  index_all();
}

const EntityForce* EntityTable::force_of(const EntityRow& row) const noexcept {
  return row.force == EntityRow::kNoForce ? nullptr : &forces_.at(row.force);
}

double EntityTable::contact_force(const EntityRow& row, nanoseconds now) const {
  return row.force == EntityRow::kNoForce ? 0 : forces_.contact(row.force, seconds_of(now));
}

}  // namespace reckon::tools
