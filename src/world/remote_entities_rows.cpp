// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The rows: how entities enter the table, go out of sight and are removed.
#include <algorithm>
#include <cstdint>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// [m] that we withdraw before rows near the border are checked again.
constexpr double kLeastStep = 0.01;

}  // namespace

// The row for a state, `row` or a new one; null if the entity leaves, is of no interest, or gets no
// room.  @param state without its orientation
RemoteEntity* RemoteEntities::row_for(RemoteEntity* row, const Inbound& update,
                                      const Arrival& arrival,
                                      deadreckon::KinematicState& state) noexcept {
  const bool body = bodies_.contains(update.entity);
  if ((update.state.appearance & pdu::kAppearanceDeactivated) != 0 && !body) {
    if (row != nullptr) drop(table_.place_of(*row), Removal::deactivated);
    outside_.forget(update.entity);
    return nullptr;
  }
  if (row != nullptr && body && row->epoch != arrival.epoch) {
    motion_.change_sender(*row, table_.place_of(*row), arrival.epoch);
    held_.forget(table_.place_of(*row));
  }
  const bool moved = row != nullptr && !ownership_.is_sender(*row, arrival);
  if (row != nullptr &&
      (row->epoch != arrival.epoch ||
       (moved && !owners_.hand_over(table_.place_of(*row), arrival.from, arrival.now)))) {
    drop(table_.place_of(*row), Removal::owner_changed);
    row = nullptr;
  }
  if (moved && row != nullptr) row->party = owners_.party(table_.place_of(*row));
  const auto kind = static_cast<std::uint8_t>(update.state.entity_type.kind);
  const double nimbus = nimbus_of(settings_.nimbus, update.state.entity_type);
  const auto verdict =
      aoim_.sight().judge(to_position(state.position), nimbus, kind, row != nullptr);
  if (!aoim::is_accepted(verdict)) {
    counts_.not_interesting.add();
    if (verdict != aoim::InterestVerdict::class_off) {
      state.orientation = orientation_from_wire(update.state.orientation, frame_);
      keep_outside(update, arrival, state, row);
    }
    if (row != nullptr) drop(table_.place_of(*row), Removal::out_of_sight);
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
    const RemoteEntity::Motion motion = bodies_.seen(row, now);
    const double spare =
        aoim_.sight().check({to_position(motion.position), to_position(row.state.motion().position),
                             now - row.state_time, nimbus_of(settings_.nimbus, row.type),
                             static_cast<std::uint8_t>(row.type.kind)},
                            kLeastStep);
    return {spare, motion.velocity.norm()};
  };
  sight_.look(now, aoim_.sight().withdrawn(), step, look, [&](std::size_t place) {
    const RemoteEntity& row = table_.rows()[place];
    // A cut-off entity is no longer received. Its owner introduces it when it returns or we join.
    if (!aoim_.sight().is_cut_off(to_position(row.motion(now).position))) keep_outside(row);
    drop(place, Removal::out_of_sight);
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

// As if the entity had been within the radius when it was received.
void RemoteEntities::enter(const OutsideEntity& entity, nanoseconds owner_heard) noexcept {
  if (table_.find(entity.id()) != nullptr) return;
  if (!ownership_.may_enter(entity.id(), entity.arrival())) return;
  // After a gap it may have moved elsewhere; its owner or a leader introduces it.
  const aoim::Position stated = to_position(entity.state().position);
  if (!aoim_.sight().has_received_since(stated, entity.arrival().now)) return;
  Arrival arrival = entity.arrival();
  arrival.now = owner_heard;
  RemoteEntity* row = add_row(entity.id(), arrival);
  if (row == nullptr) return;
  const Inbound update = entity.update();
  if (!refresh(*row, {update.state, entity.state(), entity.arrival(), {}})) {
    return drop(table_.place_of(*row), Removal::out_of_sight);  // it has no first timestamp
  }
  row->last_heard = std::max(row->last_heard, entity.last_heard());
  note_sight(*row, aoim::InterestVerdict::inside, entity.state(), entity.arrival().now);
  note_taken(*row, update);
  if (bodies_.is_orphan(*row)) doubt_row(table_.place_of(*row), row->last_heard);
  counts_.entered.add();
}

RemoteEntity* RemoteEntities::add_row(const pdu::EntityId& id, const Arrival& arrival) noexcept {
  const auto evict = [this](std::size_t place) { drop(place, Removal::no_room); };
  if (!admission_.admit(arrival, evict)) return nullptr;
  bool added = false;
  RemoteEntity* row = table_.find_or_add(id, added);
  motion_.add(*row);
  held_.push();
  time_outs_.push(nanoseconds(0));  // until its update is taken
  sight_.push();
  near_.add_row();
  beginnings_.add_row();
  changes_.discovered();
  row->epoch = arrival.epoch;
  row->first_heard = arrival.arrival;
  return row;
}

// In the table and in all parallel columns, the last row moves to `place`.
void RemoteEntities::drop(std::size_t place, Removal cause) noexcept {
  RemoteEntity& row = table_.rows()[place];
  parts_.release(row);
  changes_.removed(place, row.id, cause);
  near_.erase_row(place);
  beginnings_.erase_row(place);
  time_outs_.erase(place);
  sight_.erase(place);
  owners_.erase(place);
  held_.erase(place);
  table_.erase(place);
  motion_.erase(place, table_.rows());
  counter_of(cause).add();
}

Counter& RemoteEntities::counter_of(Removal cause) noexcept {
  if (cause == Removal::silent) return counts_.timed_out;
  return cause == Removal::no_room ? counts_.evicted : counts_.left;
}

// A row that is due may have a nanosecond left, by rounding. A body is not due before its next
// state.
void RemoteEntities::expire(nanoseconds now) noexcept {
  for (std::size_t i = time_outs_.next_due(now, 0); i < time_outs_.size();
       i = time_outs_.next_due(now, i)) {
    const RemoteEntity& row = table_.rows()[i];
    const bool body = bodies_.contains(row.id);
    if (!body && pdu::to_seconds(now - row.last_heard) > row.timeout) {
      drop(i, Removal::silent);
    } else {
      time_outs_.set(i, body ? nanoseconds::max() : now + nanoseconds(1));
    }
  }
}

}  // namespace reckon::peer
