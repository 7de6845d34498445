// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/remote_entities.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/haptics/passivity/contact_potential.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using deadreckon::ConversionError;
using std::chrono::nanoseconds;

// Nothing that its model uses moves it: its owner may then be silent for longer.
bool stands_still(const deadreckon::KinematicState& state) {
  const deadreckon::DrmTerms terms = deadreckon::drm_terms(state.algorithm);
  return (!terms.velocity || state.velocity.isZero(0)) &&
         (!terms.acceleration || state.acceleration.isZero(0)) &&
         (!terms.rotation || state.angular_velocity.isZero(0));
}

// Whether a state says, by the same timestamp, what is known already.
bool is_repeat(const RemoteEntity& row, const pdu::EntityState& pdu,
               const deadreckon::KinematicState& state) {
  return row.updates > 0 && row.timestamp == pdu.header.timestamp &&
         row.appearance == pdu.appearance && row.type == pdu.entity_type &&
         row.state.algorithm == state.algorithm && row.state.position == state.position &&
         row.state.velocity == state.velocity && row.state.acceleration == state.acceleration &&
         row.state.orientation.coeffs() == state.orientation.coeffs() &&
         row.state.angular_velocity == state.angular_velocity;
}

// How long its owner may say nothing at all and still own it. A guest announces itself by nothing
// but the heartbeats of its entities, of which more than two fit the time-out; one that starts anew
// from another port is not to be shut out for a minute either.
nanoseconds patience_with(const RemoteEntity& row) {
  if (row.epoch != 0) return RowOwners::kSilence;
  return std::clamp<nanoseconds>(pdu::from_seconds(row.timeout / 2.0), RowOwners::kSilence,
                                 RowOwners::kGuestSilence);
}

// What updates of this model tell an extrapolator.
deadreckon::SentRates sent_rates(pdu::DeadReckoningAlgorithm algorithm) {
  const deadreckon::DrmTerms terms = deadreckon::drm_terms(algorithm);
  if (terms.acceleration) return deadreckon::SentRates::acceleration;
  return terms.velocity ? deadreckon::SentRates::velocity : deadreckon::SentRates::position;
}

}  // namespace

RemoteEntities::RemoteEntities(const deadreckon::LocalFrame& frame,
                               aoim::AreaOfInterestManager& aoim, const RemoteSettings& settings,
                               Counters& counters)
    : frame_(frame),
      aoim_(aoim),
      settings_(settings),
      table_(settings.capacity),
      owners_(settings.capacity),
      clocks_(settings.capacity),
      orders_(is_adaptive() ? settings.capacity : 0),
      time_outs_(settings.capacity),
      near_(settings.capacity, settings.contact_reach),
      changes_(settings.record_changes ? settings.capacity : 0),
      outside_(settings.capacity),
      parts_(settings.convergence.settings, counters),
      accepted_(counters.make("updates_in", "updates of remote entities accepted")),
      refused_values_(counters.make("values_refused", "updates with impossible values")),
      refused_models_(counters.make("models_refused", "force models with impossible values")),
      stale_(counters.make("stale_in", "updates older than what was known, dropped")),
      repeats_(counters.make("repeats_in", "updates that said again what was known")),
      sender_leaps_(counters.make("sender_leaps", "entities whose sender's clock has leapt")),
      not_interesting_(counters.make("not_interesting", "entities outside the radius")),
      entered_(counters.make("entered", "entities that came within the radius between updates")),
      table_full_(counters.make("table_full", "entities without room in the state table")),
      evicted_(counters.make("rows_evicted", "entities dropped for others, of who has too many")),
      disputed_(counters.make("disputed_in", "updates refused, for another owns their entity")),
      timed_out_(counters.make("timed_out", "entities dropped after silence")),
      left_(counters.make("left", "entities that said good-bye or went out of sight")),
      snaps_(counters.make("snaps", "updates shown at once: teleports, frozen or resumed")) {}

void RemoteEntities::prefetch(std::span<const Inbound> updates) const noexcept {
  constexpr std::size_t kLine = 64;
  for (const Inbound& update : updates) table_.prefetch(update.entity);
  for (const Inbound& update : updates) {
    const RemoteEntity* row = table_.find(update.entity);
    if (row == nullptr) continue;
    const auto* octets = reinterpret_cast<const std::byte*>(row);
    for (std::size_t at = 0; at < sizeof *row; at += kLine) __builtin_prefetch(octets + at, 1);
    const std::size_t place = table_.place_of(*row);
    const auto* clock = reinterpret_cast<const std::byte*>(&clocks_[place]);
    for (std::size_t at = 0; at < sizeof(SenderClock); at += kLine) {
      __builtin_prefetch(clock + at, 1);
    }
  }
}

bool RemoteEntities::take(const Inbound& update, const Arrival& arrival,
                          const haptics::ServoSnapshot& servo) noexcept {
  if (aoim_.is_own(update.entity)) return false;
  RemoteEntity* row = table_.find(update.entity);
  if (!may_speak(update.entity, arrival, row)) return false;
  if (update.has_state) {
    deadreckon::KinematicState state;
    if (deadreckon::from_wire(update.state, frame_, state, settings_.acceleration) !=
        ConversionError::none) {
      refused_values_.add();
      return false;
    }
    row = row_for(row, update, arrival, state);
    if (row == nullptr) return false;
    if (is_repeat(*row, update.state, state)) return note_repeat(*row, update, arrival);
    if (!refresh(*row, {update.state, state, arrival, servo})) return false;
  } else {
    if (row == nullptr && update.has_model) {
      outside_.set_model(update.entity, arrival.epoch, update.model);
    }
    if (row == nullptr || !is_owner(*row, arrival)) return false;
  }
  note_taken(*row, update);
  return true;
}

// The rest of what an update does, once its state has been taken.
void RemoteEntities::note_taken(RemoteEntity& row, const Inbound& update) noexcept {
  if (update.has_model) take_model(row, update);
  ++row.version;
  if (update.has_model) row.neighbours = update.accounts_told;
  accepted_.add();
  const std::size_t place = table_.place_of(row);
  time_outs_.set(place, row.last_heard + pdu::from_seconds(row.timeout));
  near_.note_update(place);
  changes_.updated(place);
}

bool RemoteEntities::is_owner(const RemoteEntity& row, const Arrival& arrival) const noexcept {
  return row.epoch == arrival.epoch && owners_.owner(table_.place_of(row)) == arrival.from;
}

// `row`: of the entity, null where it has none.
bool RemoteEntities::may_speak(const pdu::EntityId& id, const Arrival& arrival,
                               const RemoteEntity* row) noexcept {
  if (row != nullptr && is_owner(*row, arrival)) return true;  // claim() sees to it that it is
  const aoim::Presence& presence = aoim_.presence();
  if (const auto epoch = presence.epoch_of(id.simulation())) {
    if (*epoch == arrival.epoch) return true;
    refuse(id, arrival, presence.source_of(*epoch).value_or(aoim::SourceAddress()));
    return false;
  }
  if (row == nullptr) return true;
  const std::size_t place = table_.place_of(*row);
  if (arrival.now - owners_.last_heard(place) > patience_with(*row)) return true;
  refuse(id, arrival, owners_.owner(place));
  return false;
}

void RemoteEntities::refuse(const pdu::EntityId& id, const Arrival& arrival,
                            const aoim::SourceAddress& owner) noexcept {
  disputed_.add();
  disputes_.note({id.simulation(), owner, arrival.from}, arrival.now);
}

// What was said already tells nothing new, but that it is still there.
bool RemoteEntities::note_repeat(RemoteEntity& row, const Inbound& update,
                                 const Arrival& arrival) noexcept {
  repeats_.add();
  row.last_heard = std::max(row.last_heard, arrival.arrival);
  take_parts(row, update.state, arrival.now, false);
  if (update.has_model) take_model(row, update);
  time_outs_.set(table_.place_of(row), row.last_heard + pdu::from_seconds(row.timeout));
  return true;
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
  const bool moved = row != nullptr && owners_.owner(table_.place_of(*row)) != arrival.from;
  if (row != nullptr &&
      (row->epoch != arrival.epoch ||
       (moved && !owners_.hand_over(table_.place_of(*row), arrival.from, arrival.now)))) {
    drop(table_.place_of(*row), left_);  // a new life of its owner
    row = nullptr;
  }
  const auto kind = static_cast<std::uint8_t>(update.state.entity_type.kind);
  const double nimbus = nimbus_of(settings_.nimbus, update.state.entity_type);
  const auto verdict = aoim_.judge(to_position(state.position), nimbus, kind, row != nullptr);
  if (!aoim::is_accepted(verdict)) {
    not_interesting_.add();
    if (row != nullptr) drop(table_.place_of(*row), left_);
    if (verdict != aoim::InterestVerdict::class_off) keep_outside(update, arrival, state);
    return nullptr;
  }
  if (row != nullptr) return row;
  outside_.forget(update.entity);
  return add_row(update.entity, arrival);
}

void RemoteEntities::keep_outside(const Inbound& update, const Arrival& arrival,
                                  const deadreckon::KinematicState& state) noexcept {
  double timeout = deadreckon::timeout(
      deadreckon::nominal_heartbeat(update.state.entity_type, stands_still(state)));
  if (update.has_model) timeout = deadreckon::timeout(deadreckon::kHapticHeartbeat);
  outside_.keep({update, arrival, state, timeout});
}

void RemoteEntities::look_outside(nanoseconds now) noexcept {
  const aoim::Interest& interest = aoim_.interest();
  outside_.look(
      now, interest.fastest_focus(),
      [&](const OutsideEntity& entity) {
        return interest.gap(to_position(entity.position(now)),
                            nimbus_of(settings_.nimbus, entity.type()));
      },
      [&](const OutsideEntity& entity) { enter(entity); });
}

// As if it had been within when it was heard.
void RemoteEntities::enter(const OutsideEntity& entity) noexcept {
  if (table_.find(entity.id()) != nullptr) return;
  if (!may_speak(entity.id(), entity.arrival(), nullptr)) return;
  RemoteEntity* row = add_row(entity.id(), entity.arrival());
  if (row == nullptr) return;
  const Inbound update = entity.update();
  if (!refresh(*row, {update.state, entity.state(), entity.arrival(), {}})) {
    return drop(table_.place_of(*row), left_);  // its first timestamp is none
  }
  note_taken(*row, update);
  entered_.add();
}

RemoteEntity* RemoteEntities::add_row(const pdu::EntityId& id, const Arrival& arrival) noexcept {
  if (!make_room(arrival) || !owners_.push(arrival.from, arrival.epoch == 0, arrival.now)) {
    table_full_.add();
    return nullptr;
  }
  bool added = false;
  RemoteEntity* row = table_.find_or_add(id, added);
  clocks_.push();
  if (is_adaptive()) row->order = &orders_.push();
  time_outs_.push(nanoseconds(0));  // until its update is taken
  near_.add_row();
  changes_.discovered();
  row->epoch = arrival.epoch;
  row->first_heard = arrival.arrival;
  return row;
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

bool RemoteEntities::refresh(RemoteEntity& row, const StateInHand& heard) noexcept {
  const auto& [pdu, state, at, servo] = heard;
  const bool known = row.updates > 0;
  SenderClock& clock = clocks_[table_.place_of(row)];
  const auto time =
      clock.local_time(pdu.header.timestamp, at.arrival, at.utc - (at.now - at.arrival), at.clock);
  if (!time) {
    stale_.add();
    return false;
  }
  if (clock.has_leapt()) sender_leaps_.add();

  const deadreckon::Pose before = row.predicted(at.now);
  const deadreckon::Pose shown = row.shown(before, at.now);
  const bool frozen = (pdu.appearance & pdu::kAppearanceFrozen) != 0;
  const bool halted = known && frozen != row.frozen;
  const bool other_model = known && state.algorithm != row.state.algorithm;
  const deadreckon::Pose told = is_adaptive() ? row.predicted(*time) : deadreckon::Pose();
  note_state(row, heard, *time);
  const deadreckon::Pose after = row.predicted(at.now);
  const bool abrupt = halted || (known && is_teleport(shown, after));
  if (is_adaptive()) note_history(row, told, abrupt || other_model);
  if (known) {
    note_jump(row, before, after, servo);
    row.convergence.restart(settings_.convergence.settings, shown, row.expected(after, at.now),
                            pdu::to_seconds(at.now));
  }
  if (abrupt) {
    row.convergence.snap();
    snaps_.add();
  }
  take_parts(row, pdu, at.now, abrupt);
  ++row.updates;
  if (first_heard_ < nanoseconds(0)) first_heard_ = at.now;
  return true;
}

void RemoteEntities::take_parts(RemoteEntity& row, const pdu::EntityState& state, nanoseconds now,
                                bool abrupt) noexcept {
  if (settings_.bodies_in_part && state.variable_parameters.empty()) return;
  parts_.update(row, state.variable_parameters, now, abrupt);
}

void RemoteEntities::note_state(RemoteEntity& row, const StateInHand& heard,
                                nanoseconds time) noexcept {
  const pdu::EntityState& pdu = heard.pdu;
  row.state = heard.state;
  row.state_time = time;
  row.timestamp = pdu.header.timestamp;
  row.last_heard = heard.at.arrival;
  row.doubted_at = RemoteEntity::kTrusted;
  row.frozen = (pdu.appearance & pdu::kAppearanceFrozen) != 0;
  row.type = pdu.entity_type;
  row.force_id = pdu.force_id;
  row.appearance = pdu.appearance;
  row.capabilities = pdu.capabilities;
  row.strokes = row.epoch != 0 && row.haptic && row.type.kind == pdu::EntityKind::life_form &&
                deadreckon::drm_terms(row.state.algorithm).acceleration &&
                !row.state.acceleration.isZero(0);
  std::copy(pdu.marking.text.begin(), pdu.marking.text.end(), row.marking.begin());
  if (!row.haptic)
    row.timeout =
        deadreckon::timeout(deadreckon::nominal_heartbeat(row.type, stands_still(row.state)));
}

bool RemoteEntities::is_teleport(const deadreckon::Pose& shown,
                                 const deadreckon::Pose& told) const noexcept {
  const deadreckon::ConvergenceSettings& settings = settings_.convergence.settings;
  const double angle = deadreckon::angle_between(told.orientation, shown.orientation);
  return !((told.position - shown.position).norm() <= settings.teleport_distance) ||
         !(angle <= settings.teleport_angle + 1e-9);  // pi may come out an ulp above
}

// Nothing of before an abrupt change predicts what comes after it. Nor does a history go on whose
// instants a better knowledge of the sender's clock has turned back.
void RemoteEntities::note_history(RemoteEntity& row, const deadreckon::Pose& told,
                                  bool abrupt) noexcept {
  const auto sample = deadreckon::motion_sample(row.state, pdu::to_seconds(row.state_time));
  deadreckon::AdaptiveOrder& order = orders_[table_.place_of(row)];
  if (!abrupt && row.updates > 0 && order.add(sample, told)) return;
  deadreckon::AdaptiveSettings settings;
  settings.sent = sent_rates(row.state.algorithm);
  order = deadreckon::AdaptiveOrder(settings);
  static_cast<void>(order.add(sample));
}

void RemoteEntities::note_jump(RemoteEntity& row, const deadreckon::Pose& before,
                               const deadreckon::Pose& after,
                               const haptics::ServoSnapshot& servo) noexcept {
  row.jump_m = (after.position - before.position).norm();
  pose_jumps_.add(row.jump_m);
  if (!row.haptic) return;
  const deadreckon::ProbeState probe{servo.device, servo.device_velocity, settings_.probe_radius};
  const Eigen::Vector3d old_force = deadreckon::evaluate(row.model, before, probe);
  const Eigen::Vector3d new_force = deadreckon::evaluate(row.model, after, probe);
  if (!old_force.isZero() || !new_force.isZero()) force_jumps_.add((new_force - old_force).norm());
}

void RemoteEntities::take_model(RemoteEntity& row, const Inbound& update) noexcept {
  deadreckon::ForceModel model;
  row.model_refused = deadreckon::from_wire(update.model, model) != ConversionError::none ||
                      !haptics::is_usable(haptics::parameters(model, {}, settings_.probe_radius));
  if (row.model_refused) {
    last_refused_ = row.id;
    return refused_models_.add();
  }
  row.model = model;
  row.haptic = true;
  // Its owner may be silent for as long as it lets the force be believed.
  row.timeout = std::max(deadreckon::timeout(deadreckon::kHapticHeartbeat), model.validity);
  row.valid_until = row.last_heard + pdu::from_seconds(model.validity);
  near_.note_model(table_.place_of(row));
}

// In the table and all beside it the last row goes to `place`.
void RemoteEntities::drop(std::size_t place, Counter& why) noexcept {
  RemoteEntity& row = table_.rows()[place];
  parts_.release(row);
  changes_.removed(place, row.id);
  near_.erase_row(place);
  time_outs_.erase(place);
  owners_.erase(place);
  clocks_.erase(place);
  table_.erase(place);
  if (is_adaptive()) {
    orders_.erase(place);
    if (place < orders_.size()) table_.rows()[place].order = &orders_[place];
  }
  why.add();
}

ShownParts RemoteEntities::parts(const pdu::EntityId& id, nanoseconds now) const noexcept {
  const RemoteEntity* row = table_.find(id);
  return row == nullptr ? ShownParts() : parts_.shown(*row, now);
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
