// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// States of entities that are kept but not shown: states of entities outside the radius of
// interest, and states meant for listeners that are farther away than we are.
#include <algorithm>
#include <array>
#include <limits>

#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();  // [s]

}  // namespace

// Of an entity outside, only those states are kept that its owner maintains for listeners at this
// distance.
void RemoteEntities::keep_outside(const Inbound& update, const Arrival& arrival,
                                  const deadreckon::KinematicState& state,
                                  const RemoteEntity* row) noexcept {
  double timeout = deadreckon::timeout(
      deadreckon::nominal_heartbeat(update.state.entity_type, deadreckon::stands_still(state)));
  if (update.has_model) timeout = deadreckon::timeout(deadreckon::kHapticHeartbeat);
  if (bodies_.contains(update.entity)) timeout = kForEver;
  if (!held_.is_on() || arrival.group == aoim::kBaseGroup)
    return keep_outside(OutsideEntity(update, arrival, state, timeout));
  if (row == nullptr) return;
  const HeldState& held = held_.behind(table_.place_of(*row), settings_.near_rows - 1);
  if (!held.is_heard) return;
  Inbound known = update;
  known.state.header.timestamp = held.timestamp;
  Arrival then = arrival;
  then.arrival = held.time;
  then.group = aoim::kBaseGroup;
  keep_outside(OutsideEntity(known, then, held.state, timeout));
}

// As if the entity had been received outside. Its time is known, so no clock is used again.
void RemoteEntities::keep_outside(const RemoteEntity& row) noexcept {
  const std::size_t place = table_.place_of(row);
  HeldState known{*row.state, row.state_time, row.timestamp, aoim::kBaseGroup, true};
  const bool near = held_.is_on() && held_.shown_by(place) != aoim::kBaseGroup;
  if (near) known = held_.behind(place, settings_.near_rows - 1);
  if (!known.is_heard) return;

  Inbound update;
  update.entity = row.id;
  update.has_state = true;
  pdu::EntityState& pdu = update.state;
  pdu.entity_id = row.id;
  pdu.header.timestamp = known.timestamp;
  pdu.entity_type = row.type;
  pdu.force_id = row.force_id;
  pdu.appearance = row.appearance;
  pdu.capabilities = row.capabilities;
  std::copy_n(row.marking.begin(), pdu.marking.text.size(), pdu.marking.text.begin());
  std::array<std::byte, 32 * deadreckon::PartState::kCapacity> parts;
  if (const deadreckon::PartState* state = parts_.received(row))
    pdu.variable_parameters = std::span(parts).first(deadreckon::to_wire(*state, parts));
  deadreckon::ForceModel model = row.model;
  model.validity = std::max(pdu::to_seconds(row.valid_until - row.last_heard), 0.0);
  // A doubted entity is not felt after its return either, until it sends its position.
  const bool felt = row.haptic && row.felt_until == RemoteEntity::kTrusted;
  update.has_model =
      felt && deadreckon::to_wire(model, update.model) == deadreckon::ConversionError::none;

  Arrival arrival;
  arrival.now = owners_.last_heard(place);
  arrival.arrival = known.time;
  arrival.epoch = row.epoch;
  arrival.clock.aligned = false;
  arrival.from = owners_.owner(place);
  OutsideEntity entity(update, arrival, known.state,
                       bodies_.contains(row.id) ? kForEver : row.timeout);
  entity.set_last_heard(row.last_heard);
  keep_outside(entity);
}

void RemoteEntities::keep_outside(const OutsideEntity& entity) noexcept {
  outside_.keep(entity, admission_.has_room_outside());
}

void RemoteEntities::note_held(const RemoteEntity& row, const ReceivedState& heard,
                               nanoseconds time, bool newest) noexcept {
  if (!held_.is_on()) return;
  const aoim::TierTable& tiers = aoim_.tiers();
  held_.note(table_.place_of(row), tiers.row_of(tiers.tier_of(heard.at.group)),
             {heard.state, time, heard.pdu.header.timestamp, heard.at.group, true}, newest);
}

void RemoteEntities::leave_groups(std::span<const aoim::GroupIndex> groups,
                                  nanoseconds now) noexcept {
  for (const aoim::GroupIndex group : groups) {
    const std::size_t tier = aoim_.tiers().tier_of(group);
    if (!aoim_.tiers().kind(tier).runs_ahead) continue;
    held_.leave(group, aoim_.tiers().row_of(tier),
                [&](std::size_t place, const HeldState& held) { go_back(place, held, now); });
  }
}

// Without a jump, the same as for any update.
void RemoteEntities::go_back(std::size_t place, const HeldState& held, nanoseconds now) noexcept {
  RemoteEntity& row = table_.rows()[place];
  motion_.go_back(row, place, held, now);
  ++row.version;
  near_.note_update(place);
  changes_.updated(place);
}

}  // namespace reckon::peer
