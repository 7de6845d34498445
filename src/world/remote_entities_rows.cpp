// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which rows there are and who may change them: how entities come into the table and go.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// How long its owner may say nothing at all and still own it.
nanoseconds patience_with(const RemoteEntity& row) {
  return row.epoch != 0 ? RowOwners::kSilence : RowOwners::patience_with_guest(row.timeout);
}

// [m] that we withdraw before what is near the border is looked at again.
constexpr double kLeastStep = 0.01;

// As ==, without a call: it is asked at each update.
bool same(const aoim::SourceAddress& a, const aoim::SourceAddress& b) {
  if ((a.boot | b.boot) != 0) return a.boot == b.boot;
  using Words = std::array<std::uint64_t, 2>;
  static_assert(sizeof a.octets == sizeof(Words));
  const auto left = std::bit_cast<Words>(a.octets), right = std::bit_cast<Words>(b.octets);
  return ((left[0] ^ right[0]) | (left[1] ^ right[1])) == 0 && a.port == b.port;
}

}  // namespace

bool RemoteEntities::is_owner(const RemoteEntity& row, const Arrival& arrival) const noexcept {
  return row.epoch == arrival.epoch && same(owners_.owner(table_.place_of(row)), arrival.from);
}

// `row`: of the entity, null where it has none. `owner`: set where it is refused.
Voice RemoteEntities::voice_of(const pdu::EntityId& id, const Arrival& arrival,
                               const RemoteEntity* row, aoim::SourceAddress& owner) const noexcept {
  // claim() sees to it that it is.
  if (row != nullptr && is_owner(*row, arrival)) return Voice::owner;
  const aoim::Presence& presence = aoim_.presence();
  if (const auto epoch = presence.epoch_of(id.simulation())) {
    if (*epoch == arrival.epoch) return Voice::owner;
    owner = presence.source_of(*epoch).value_or(aoim::SourceAddress());
    return Voice::refused;
  }
  if (row == nullptr) {
    const aoim::SourceAddress* guest = outside_.guest_of(id, arrival.now);
    if (guest == nullptr) return Voice::nobody;
    if (arrival.epoch == 0 && same(*guest, arrival.from)) return Voice::owner;
    owner = *guest;
    return Voice::refused;
  }
  const std::size_t place = table_.place_of(*row);
  if (arrival.now - owners_.last_heard(place) > patience_with(*row)) return Voice::nobody;
  owner = owners_.owner(place);
  return Voice::refused;
}

bool RemoteEntities::may_speak(const pdu::EntityId& id, const Arrival& arrival,
                               const RemoteEntity* row) noexcept {
  aoim::SourceAddress owner;
  if (voice_of(id, arrival, row, owner) != Voice::refused) return true;
  refuse(id, arrival, owner);
  return false;
}

Voice RemoteEntities::hear(std::span<const pdu::EntityId> ids, const Arrival& arrival) noexcept {
  const pdu::EntityId* other = nullptr;
  aoim::SourceAddress owner;
  for (const pdu::EntityId& id : ids) {
    const Voice voice = aoim_.presence().is_own(id) ? Voice::refused
                                                    : voice_of(id, arrival, table_.find(id), owner);
    if (voice == Voice::owner) return voice;
    if (voice == Voice::refused && other == nullptr) other = &id;
  }
  if (other == nullptr) return Voice::nobody;
  refuse(*other, arrival, owner);
  return Voice::refused;
}

void RemoteEntities::refuse(const pdu::EntityId& id, const Arrival& arrival,
                            const aoim::SourceAddress& owner) noexcept {
  disputed_.add();
  disputes_.note({id.simulation(), owner, arrival.from}, arrival.now);
}

// The row that a state belongs to, `row` or a new one; null where the entity leaves, is of no
// interest, or has no room.
RemoteEntity* RemoteEntities::row_for(RemoteEntity* row, const Inbound& update,
                                      const Arrival& arrival,
                                      const deadreckon::KinematicState& state) noexcept {
  if ((update.state.appearance & pdu::kAppearanceDeactivated) != 0) {
    if (row != nullptr) drop(table_.place_of(*row), left_);
    outside_.forget(update.entity);
    return nullptr;
  }
  const bool moved = row != nullptr && !same(owners_.owner(table_.place_of(*row)), arrival.from);
  if (row != nullptr &&
      (row->epoch != arrival.epoch ||
       (moved && !owners_.hand_over(table_.place_of(*row), arrival.from, arrival.now)))) {
    drop(table_.place_of(*row), left_);  // a new life of its owner
    row = nullptr;
  }
  if (moved && row != nullptr) row->party = owners_.party(table_.place_of(*row));
  const auto kind = static_cast<std::uint8_t>(update.state.entity_type.kind);
  const double nimbus = nimbus_of(settings_.nimbus, update.state.entity_type);
  const auto verdict =
      aoim_.sight().judge(to_position(state.position), nimbus, kind, row != nullptr);
  if (!aoim::is_accepted(verdict)) {
    not_interesting_.add();
    if (verdict != aoim::InterestVerdict::class_off) keep_outside(update, arrival, state, row);
    if (row != nullptr) drop(table_.place_of(*row), left_);
    return nullptr;
  }
  if (row == nullptr) {
    outside_.forget(update.entity);
    row = add_row(update.entity, arrival);
  }
  if (row != nullptr) note_sight(*row, verdict, state, arrival.now);
  return row;
}

void RemoteEntities::note_sight(const RemoteEntity& row, aoim::InterestVerdict verdict,
                                const deadreckon::KinematicState& state, nanoseconds now) noexcept {
  const bool inside = verdict == aoim::InterestVerdict::inside;
  sight_.note_update(table_.place_of(row), aoim_.sight().withdrawn(),
                     inside ? aoim_.sight().interest().margin() : 0.0,
                     !deadreckon::stands_still(state), now);
}

void RemoteEntities::look_shown(nanoseconds now) noexcept {
  const double step = std::max(aoim_.sight().interest().margin() / 10.0, kLeastStep);
  const auto look = [&](std::size_t place) -> Sight {
    const RemoteEntity& row = table_.rows()[place];
    const deadreckon::Pose pose = row.predicted(now);
    const aoim::Position position = to_position(pose.position);
    const auto kind = static_cast<std::uint8_t>(row.type.kind);
    const double nimbus = nimbus_of(settings_.nimbus, row.type);
    const double speed = deadreckon::stands_still(row.state) ? 0.0 : pose.velocity.norm();
    double spare = aoim_.sight().spare(position, nimbus, kind);
    // It counts what leaves; on the very border it stays.
    if (!(spare > 0.0) && aoim::is_accepted(aoim_.sight().judge(position, nimbus, kind, true)))
      spare = kLeastStep;
    return {spare, speed};
  };
  sight_.look(now, aoim_.sight().withdrawn(), step, look, [&](std::size_t place) {
    keep_outside(table_.rows()[place]);
    drop(place, left_);
  });
}

void RemoteEntities::look_outside(nanoseconds now) noexcept {
  outside_.look(
      now, aoim_.sight().interest().fastest_focus(),
      [&](const OutsideEntity& entity) {
        return aoim_.sight().gap(to_position(entity.position(now)),
                                 nimbus_of(settings_.nimbus, entity.type()));
      },
      [&](const OutsideEntity& entity, nanoseconds owner_heard) { enter(entity, owner_heard); });
}

// As if it had been within when it was heard.
void RemoteEntities::enter(const OutsideEntity& entity, nanoseconds owner_heard) noexcept {
  if (table_.find(entity.id()) != nullptr) return;
  if (!may_speak(entity.id(), entity.arrival(), nullptr)) return;
  Arrival arrival = entity.arrival();
  arrival.now = owner_heard;
  RemoteEntity* row = add_row(entity.id(), arrival);
  if (row == nullptr) return;
  const Inbound update = entity.update();
  if (!refresh(*row, {update.state, entity.state(), entity.arrival(), {}})) {
    return drop(table_.place_of(*row), left_);  // its first timestamp is none
  }
  row->last_heard = std::max(row->last_heard, entity.last_heard());
  note_sight(*row, aoim::InterestVerdict::inside, row->state, entity.arrival().now);
  note_taken(*row, update);
  entered_.add();
}

RemoteEntity* RemoteEntities::add_row(const pdu::EntityId& id, const Arrival& arrival) noexcept {
  if (!make_guest_room(arrival)) {
    strangers_full_.add();
    last_stranger_ = arrival.from;
    return nullptr;
  }
  if (!make_room(arrival) || !owners_.push(arrival.from, arrival.epoch == 0, arrival.now)) {
    table_full_.add();
    return nullptr;
  }
  bool added = false;
  RemoteEntity* row = table_.find_or_add(id, added);
  clocks_.push();
  held_.push();
  if (is_adaptive()) row->order = &orders_.push();
  time_outs_.push(nanoseconds(0));  // until its update is taken
  sight_.push();
  near_.add_row();
  changes_.discovered();
  row->epoch = arrival.epoch;
  row->first_heard = arrival.arrival;
  return row;
}

// Guests share what strangers may have. What is shown makes room of what is not, up to half of it;
// then a row of the host with the most makes it.
bool RemoteEntities::make_guest_room(const Arrival& arrival) noexcept {
  if (arrival.epoch != 0) return true;
  const std::size_t most = settings_.strangers_memory;
  while (strangers_octets() + row_octets_ > most) {
    const bool has_half = (owners_.guests() + 1) * row_octets_ > most / 2;
    if (!has_half && outside_.give_up_guest()) continue;
    const auto place = owners_.guest_to_give_up(arrival.from);
    if (!place) return false;
    last_evicted_ = owners_.owner(*place);
    drop(*place, evicted_);
  }
  return true;
}

// In a full table, a row of who has too many makes it.
bool RemoteEntities::make_room(const Arrival& arrival) noexcept {
  if (table_.rows().size() < table_.capacity()) return true;
  const auto place = owners_.row_to_give_up(arrival.from, arrival.epoch == 0);
  if (!place) return false;
  last_evicted_ = owners_.owner(*place);
  drop(*place, evicted_);
  return true;
}

// In the table and all beside it the last row goes to `place`.
void RemoteEntities::drop(std::size_t place, Counter& why) noexcept {
  RemoteEntity& row = table_.rows()[place];
  parts_.release(row);
  changes_.removed(place, row.id);
  near_.erase_row(place);
  time_outs_.erase(place);
  sight_.erase(place);
  owners_.erase(place);
  clocks_.erase(place);
  held_.erase(place);
  table_.erase(place);
  if (is_adaptive()) {
    orders_.erase(place);
    if (place < orders_.size()) table_.rows()[place].order = &orders_[place];
  }
  why.add();
}

void RemoteEntities::expire(nanoseconds now) noexcept {
  for (std::size_t i = time_outs_.next_due(now, 0); i < time_outs_.size();
       i = time_outs_.next_due(now, i)) {
    const RemoteEntity& row = table_.rows()[i];
    if (pdu::to_seconds(now - row.last_heard) > row.timeout) {
      drop(i, timed_out_);
    } else {
      time_outs_.set(i, now + nanoseconds(1));  // not yet, by a nanosecond of rounding
    }
  }
}

}  // namespace reckon::peer
