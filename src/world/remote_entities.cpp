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
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/world/addressed.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {
namespace {

using deadreckon::ConversionError;
using std::chrono::nanoseconds;

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

// Of one entity that is shown, in all tables that have a row for it.
std::size_t row_octets(const RemoteSettings& settings, bool adaptive) {
  constexpr std::size_t kBeside = 320;  // owner, instants, index, near search, list of changes
  std::size_t octets = sizeof(RemoteEntity) + sizeof(SenderClock) + kBeside;
  if (adaptive) octets += sizeof(deadreckon::AdaptiveOrder);
  if (settings.record_changes) octets += sizeof(RemoteCopy);  // of the program
  return octets + settings.near_rows * sizeof(HeldState);
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
      row_octets_(row_octets(settings, is_adaptive())),
      table_(settings.capacity),
      owners_(settings.capacity),
      clocks_(settings.capacity),
      orders_(is_adaptive() ? settings.capacity : 0),
      held_(settings.near_rows, settings.capacity),
      time_outs_(settings.capacity),
      sight_(settings.capacity),
      near_(settings.capacity, settings.contact_reach),
      changes_(settings.record_changes ? settings.capacity : 0),
      outside_(settings.capacity),
      parts_(settings.convergence.settings, counters),
      accepted_(counters.make("updates_in", "updates of remote entities accepted")),
      refused_values_(counters.make("values_refused", "updates with impossible values")),
      refused_models_(counters.make("models_refused", "force models with impossible values")),
      untouchables_(counters.make("touch_refused", "force models of who may not touch")),
      reserved_(counters.make("reserved_ids_in",
                              "updates of IDs that no entity can have, such as 0:0:0 and 65535")),
      stale_(counters.make("stale_in", "updates older than what was known, dropped")),
      repeats_(counters.make("repeats_in", "updates that said again what was known")),
      sender_leaps_(counters.make("sender_leaps", "entities whose sender's clock has leapt")),
      not_interesting_(counters.make("not_interesting", "entities outside the radius")),
      entered_(counters.make("entered", "entities that came within the radius between updates")),
      table_full_(counters.make("table_full", "entities without room in the state table")),
      strangers_full_(counters.make("strangers_full",
                                    "entities of plain DIS programs without room in their memory")),
      evicted_(counters.make("rows_evicted", "entities dropped for others, of who has too many")),
      disputed_(counters.make("disputed_in", "updates refused, for another owns their entity")),
      timed_out_(counters.make("timed_out", "entities dropped after silence")),
      left_(counters.make("left", "entities that said good-bye or went out of sight")),
      snaps_(counters.make("snaps", "updates shown at once: teleports, frozen or resumed")) {}

void RemoteEntities::prefetch(std::span<const Inbound> updates) const noexcept {
  for (const Inbound& update : updates) table_.prefetch(update.entity);
  for (const Inbound& update : updates) {
    const RemoteEntity* row = table_.find(update.entity);
    if (row == nullptr) continue;
    const std::size_t place = table_.place_of(*row);
    StateTable::prefetch_row(*row);
    clocks_.prefetch(place);
    owners_.prefetch(place);
    time_outs_.prefetch(place);
    sight_.prefetch(place);
    near_.prefetch(place);
  }
}

bool RemoteEntities::take(const Inbound& update, const Arrival& arrival,
                          const haptics::ServoSnapshot& servo) noexcept {
  if (aoim_.presence().is_own(update.entity)) return false;
  if (!is_nameable(update.entity)) return reserved_.add(), false;
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
    const StateInHand heard{update.state, state, arrival, servo};
    if (is_repeat(*row, update.state, state)) return note_repeat(*row, update, heard);
    if (!refresh(*row, heard)) return false;
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

// What was said already tells nothing new, but that it is still there.
bool RemoteEntities::note_repeat(RemoteEntity& row, const Inbound& update,
                                 const StateInHand& heard) noexcept {
  repeats_.add();
  row.last_heard = std::max(row.last_heard, heard.at.arrival);
  note_held(row, heard, row.state_time, true);
  take_parts(row, update.state, heard.at.now, false);
  if (update.has_model) take_model(row, update);
  time_outs_.set(table_.place_of(row), row.last_heard + pdu::from_seconds(row.timeout));
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
    if (known)
      note_held(row, heard, row.state_time + pdu::difference(pdu.header.timestamp, row.timestamp),
                false);
    return false;
  }
  if (clock.has_leapt()) sender_leaps_.add();

  const deadreckon::Pose before = row.predicted(at.now);
  const deadreckon::Pose shown = row.shown(before, at.now);
  const bool frozen = (pdu.appearance & pdu::kAppearanceFrozen) != 0;
  const bool halted = known && frozen != row.frozen;
  const bool other_model = known && state.algorithm != row.state.algorithm;
  const deadreckon::Pose expected = is_adaptive() ? row.predicted(*time) : deadreckon::Pose();
  note_state(row, heard, *time);
  note_held(row, heard, *time, true);
  const deadreckon::Pose after = row.predicted(at.now);
  const bool abrupt = halted || (known && is_teleport(shown, after));
  if (is_adaptive()) note_history(row, expected, abrupt || other_model);
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
  row.doubted_at = row.felt_until = RemoteEntity::kTrusted;
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
    row.timeout = deadreckon::timeout(
        deadreckon::nominal_heartbeat(row.type, deadreckon::stands_still(row.state)));
}

bool RemoteEntities::is_teleport(const deadreckon::Pose& shown,
                                 const deadreckon::Pose& expected) const noexcept {
  const deadreckon::ConvergenceSettings& settings = settings_.convergence.settings;
  const double angle = deadreckon::angle_between(expected.orientation, shown.orientation);
  return !((expected.position - shown.position).norm() <= settings.teleport_distance) ||
         !(angle <= settings.teleport_angle + 1e-9);  // pi may come out an ulp above
}

// Nothing of before an abrupt change predicts what comes after it. Nor does a history go on whose
// instants a better knowledge of the sender's clock has turned back.
void RemoteEntities::note_history(RemoteEntity& row, const deadreckon::Pose& expected,
                                  bool abrupt) noexcept {
  const auto sample = deadreckon::motion_sample(row.state, pdu::to_seconds(row.state_time));
  deadreckon::AdaptiveOrder& order = orders_[table_.place_of(row)];
  if (!abrupt && row.updates > 0 && order.add(sample, expected)) return;
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
  if (!may_touch(row)) return;
  model.validity = std::min(model.validity, settings_.longest_validity);
  row.model = model;
  row.haptic = true;
  row.party = owners_.party(table_.place_of(row));
  // Its owner may be silent for as long as it lets the force be believed.
  row.timeout = std::max(deadreckon::timeout(deadreckon::kHapticHeartbeat), model.validity);
  row.valid_until = row.last_heard + pdu::from_seconds(model.validity);
  near_.note_model(table_.place_of(row));
}

// claim() and may_speak() have seen to it that a row with an epoch is of the peer of its number.
bool RemoteEntities::may_touch(const RemoteEntity& row) noexcept {
  if (settings_.touch.allows(row.id.simulation(), row.epoch != 0)) return true;
  last_untouchable_ = {row.id, owners_.owner(table_.place_of(row))};
  untouchables_.add();
  return false;
}

ShownParts RemoteEntities::parts(const pdu::EntityId& id, nanoseconds now) const noexcept {
  const RemoteEntity* row = table_.find(id);
  return row == nullptr ? ShownParts() : parts_.shown(*row, now);
}

}  // namespace reckon::peer
