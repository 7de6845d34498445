// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/remote_entities.hpp"

#include <algorithm>

#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/world/addressed.hpp"

namespace reckon::peer {
namespace {

using deadreckon::ConversionError;
using std::chrono::nanoseconds;

// Whether a state repeats the known state with the same timestamp.
bool is_repeat(const RemoteEntity& row, const pdu::EntityState& pdu,
               const deadreckon::KinematicState& state) {
  return row.updates > 0 && row.timestamp == pdu.header.timestamp &&
         row.appearance == pdu.appearance && row.type == pdu.entity_type &&
         row.state->algorithm == state.algorithm && row.state->position == state.position &&
         row.state->velocity == state.velocity && row.state->acceleration == state.acceleration &&
         row.state->orientation.coeffs() == state.orientation.coeffs() &&
         row.state->angular_velocity == state.angular_velocity;
}

}  // namespace

RemoteEntities::RemoteEntities(const deadreckon::LocalFrame& frame,
                               aoim::AreaOfInterestManager& aoim, const RemoteSettings& settings,
                               Counters& counters)
    : frame_(frame),
      aoim_(aoim),
      settings_(settings),
      parts_(settings.convergence.settings, counters),
      counts_(counters),
      table_(settings.capacity),
      owners_(settings.capacity),
      motion_(settings_, counts_),
      held_(settings.near_rows, settings.capacity),
      time_outs_(settings.capacity),
      sight_(settings.capacity),
      beginnings_(settings.capacity),
      near_(settings.capacity, settings.contact_reach),
      changes_(settings.record_changes ? settings.capacity : 0),
      outside_(settings.capacity),
      ownership_(aoim, table_, owners_, outside_, bodies_, counts_.disputed),
      admission_(settings_, table_, owners_, outside_, counts_),
      touch_(settings.touch),
      models_(settings_, owners_, touch_, counts_),
      bodies_(settings.body_owners, aoim.presence(), counts_) {
  near_.mark_beginnings(beginnings_, owners_);
}

void RemoteEntities::prefetch(std::span<const Inbound> updates) const noexcept {
  for (const Inbound& update : updates) table_.prefetch(update.entity);
  for (const Inbound& update : updates) {
    const RemoteEntity* row = table_.find(update.entity);
    if (row == nullptr) continue;
    const std::size_t place = table_.place_of(*row);
    StateTable::prefetch_row(*row);
    motion_.prefetch(place);
    owners_.prefetch(place);
    time_outs_.prefetch(place);
    sight_.prefetch(place);
    near_.prefetch(place);
  }
}

bool RemoteEntities::take(const Inbound& update, const Arrival& arrival,
                          const haptics::ServoSnapshot& servo) noexcept {
  if (aoim_.presence().is_own(update.entity)) {
    // presence settles a conflict with a peer; plain DIS has no such mechanism
    if (arrival.epoch == 0) static_cast<void>(sender_right(std::span(&update.entity, 1), arrival));
    return false;
  }
  if (!is_nameable(update.entity)) return counts_.reserved.add(), false;
  RemoteEntity* row = table_.find(update.entity);
  if (!ownership_.may_update(update, arrival, row)) return false;
  if (update.has_state) {
    const bool watched =
        row == nullptr || update.has_model || motion_.is_watched(*row, update.state, arrival.now);
    deadreckon::KinematicState state;
    if (motion_from_wire(update.state, frame_, state, settings_.acceleration) !=
        ConversionError::none) {
      counts_.refused_values.add();
      return false;
    }
    row = row_for(row, update, arrival, state);
    if (row == nullptr) return false;
    if (watched) state.orientation = orientation_from_wire(update.state.orientation, frame_);
    const ReceivedState heard{update.state, state, arrival, servo, watched ? nullptr : &frame_};
    if (is_repeat(*row, update.state, state)) return note_repeat(*row, update, heard);
    if (!refresh(*row, heard)) return false;
  } else {
    if (row == nullptr && update.has_model && !bodies_.contains(update.entity)) {
      outside_.set_model(update.entity, arrival.epoch, update.model);
    }
    if (row == nullptr || !ownership_.is_owner(*row, arrival)) return false;
  }
  note_taken(*row, update);
  return true;
}

// The remaining effects of an update, after its state was taken.
void RemoteEntities::note_taken(RemoteEntity& row, const Inbound& update) noexcept {
  if (update.has_model) take_model(row, update.model);
  ++row.version;
  if (update.has_model) row.neighbours = update.accounts_told;
  counts_.accepted.add();
  const std::size_t place = table_.place_of(row);
  time_outs_.set(place, row.last_heard + pdu::from_seconds(row.timeout));
  near_.note_update(place);
  changes_.updated(place);
}

// A repetition shows only that the entity still exists.
bool RemoteEntities::note_repeat(RemoteEntity& row, const Inbound& update,
                                 const ReceivedState& heard) noexcept {
  row.state.forget_looks();  // is_repeat() was none
  counts_.repeats.add();
  row.last_heard = std::max(row.last_heard, heard.at.arrival);
  note_held(row, heard, row.state_time, true);
  take_parts(row, update.state, heard.at.now, false);
  if (update.has_model) take_model(row, update.model);
  time_outs_.set(table_.place_of(row), row.last_heard + pdu::from_seconds(row.timeout));
  return true;
}

bool RemoteEntities::refresh(RemoteEntity& row, const ReceivedState& heard) noexcept {
  const RemoteMotion::Outcome outcome = motion_.take(row, table_.place_of(row), heard);
  if (outcome == RemoteMotion::Outcome::stale) {
    const auto newer = pdu::difference(heard.pdu.header.timestamp, row.timestamp);
    if (row.updates > 0) note_held(row, heard, row.state_time + newer, false);
    return false;
  }
  note_held(row, heard, row.state_time, true);
  take_parts(row, heard.pdu, heard.at.now, outcome == RemoteMotion::Outcome::abrupt);
  ++row.updates;
  if (first_heard_ < nanoseconds(0)) first_heard_ = heard.at.now;
  return true;
}

void RemoteEntities::take_parts(RemoteEntity& row, const pdu::EntityState& state, nanoseconds now,
                                bool abrupt) noexcept {
  if (settings_.bodies_in_part && state.variable_parameters.empty()) return;
  parts_.update(row, state.variable_parameters, now, abrupt);
}

void RemoteEntities::take_model(RemoteEntity& row, const pdu::HapticRecord& model) noexcept {
  if (bodies_.contains(row.id)) return;  // a servo renders it as an object of the scene
  const std::size_t place = table_.place_of(row);
  if (models_.take(row, place, model)) near_.note_model(place);
}

ShownParts RemoteEntities::parts(const pdu::EntityId& id, nanoseconds now) const noexcept {
  const RemoteEntity* row = table_.find(id);
  return row == nullptr ? ShownParts() : parts_.shown(*row, now);
}

}  // namespace reckon::peer
