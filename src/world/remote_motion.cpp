// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/remote_motion.hpp"

#include <algorithm>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// The rates that updates of this model give to an extrapolator.
deadreckon::SentRates sent_rates(pdu::DeadReckoningAlgorithm algorithm) {
  const deadreckon::DrmTerms terms = deadreckon::drm_terms(algorithm);
  if (terms.acceleration) return deadreckon::SentRates::acceleration;
  return terms.velocity ? deadreckon::SentRates::velocity : deadreckon::SentRates::position;
}

constexpr double kKnock = 0.1;  // [m/s]

// A body of the scene that was knocked moves on at its new speed at once: its velocity had a step.
deadreckon::Pose knocked(const RemoteEntity& row, deadreckon::Pose shown,
                         const deadreckon::Pose& before, const deadreckon::Pose& after) noexcept {
  const bool is_body = aoim::BodyOwners::are_for(row.id);
  if (!is_body || (after.velocity - before.velocity).norm() < kKnock) return shown;
  shown.velocity = after.velocity;
  shown.angular_velocity = after.angular_velocity;
  return shown;
}

}  // namespace

RemoteMotion::RemoteMotion(const RemoteSettings& settings, const RemoteCounters& counts)
    : settings_(settings),
      counts_(counts),
      is_adaptive_(settings.is_adaptive()),
      clocks_(settings.capacity),
      orders_(is_adaptive_ ? settings.capacity : 0) {}

void RemoteMotion::add(RemoteEntity& row) {
  clocks_.push();
  if (is_adaptive_) row.order = &orders_.push();
}

void RemoteMotion::erase(std::size_t place, std::span<RemoteEntity> rows) noexcept {
  clocks_.erase(place);
  if (!is_adaptive_) return;
  orders_.erase(place);
  if (place < rows.size()) rows[place].order = &orders_[place];
}

bool RemoteMotion::is_watched(RemoteEntity& row, const pdu::EntityState& pdu,
                              nanoseconds now) const noexcept {
  const bool looked_at = row.state.is_watched(now);
  const bool needs_each = is_adaptive_ || settings_.near_rows > 0;  // a history, or held states
  const bool is_plain = !row.haptic && row.parts == 0 && pdu.variable_parameters.empty() &&
                        !aoim::BodyOwners::are_for(row.id) &&
                        !deadreckon::drm_terms(pdu.dead_reckoning.algorithm).body_axes;
  const bool goes_on = row.timestamp != pdu.header.timestamp &&
                       row.frozen == ((pdu.appearance & pdu::kAppearanceFrozen) != 0);
  return looked_at || needs_each || !is_plain || !goes_on;
}

RemoteMotion::Outcome RemoteMotion::take(RemoteEntity& row, std::size_t place,
                                         const ReceivedState& heard) noexcept {
  const auto& [pdu, state, at, servo, unturned_in] = heard;
  const bool known = row.updates > 0;
  SenderClock& clock = clocks_[place];
  const auto time =
      clock.local_time(pdu.header.timestamp, at.arrival, at.utc - (at.now - at.arrival), at.clock);
  if (!time) {
    counts_.stale.add();
    return Outcome::stale;
  }
  if (clock.has_leapt()) counts_.sender_leaps.add();
  if (unturned_in != nullptr) return take_unwatched(row, heard, *time);

  const deadreckon::Pose before = row.predicted(at.now);
  const deadreckon::Pose shown = row.shown(before, at.now);
  const bool frozen = (pdu.appearance & pdu::kAppearanceFrozen) != 0;
  const bool halted = known && frozen != row.frozen;
  const bool other_model = known && state.algorithm != row.state.motion().algorithm;
  const deadreckon::Pose expected = is_adaptive_ ? row.predicted(*time) : deadreckon::Pose();
  note_state(row, heard, *time);
  const deadreckon::Pose after = row.predicted(at.now);
  const bool abrupt = halted || (known && is_teleport(shown, after));
  if (is_adaptive_) note_history(row, place, expected, abrupt || other_model);
  if (known) {
    note_jump(row, before.position, after.position);
    if (row.haptic) note_force_jump(row, before, after, servo);
    row.convergence.restart(settings_.convergence.settings, knocked(row, shown, before, after),
                            row.expected(after, at.now), pdu::to_seconds(at.now));
  }
  if (abrupt) snap(row);
  row.state.forget_looks();
  return abrupt ? Outcome::abrupt : Outcome::smooth;
}

// Nobody has seen a pose from which the shown one would have to converge.
RemoteMotion::Outcome RemoteMotion::take_unwatched(RemoteEntity& row, const ReceivedState& heard,
                                                   nanoseconds time) noexcept {
  const bool known = row.updates > 0;
  const Eigen::Vector3d before = row.motion(heard.at.now).position;
  note_state(row, heard, time);
  if (known) {
    note_jump(row, before, row.motion(heard.at.now).position);
    row.convergence.snap(pdu::to_seconds(heard.at.now));
  }
  return Outcome::smooth;
}

void RemoteMotion::snap(RemoteEntity& row) noexcept {
  row.convergence.snap();
  counts_.snaps.add();
}

void RemoteMotion::note_state(RemoteEntity& row, const ReceivedState& heard,
                              nanoseconds time) noexcept {
  const pdu::EntityState& pdu = heard.pdu;
  if (heard.unturned_in != nullptr) {
    row.state.put(heard.state, pdu.orientation, *heard.unturned_in);
  } else {
    row.state = heard.state;
  }
  row.state_time = time;
  row.timestamp = pdu.header.timestamp;
  row.last_heard = heard.at.arrival;
  row.doubted_at = row.felt_until = row.pressed_at = RemoteEntity::kTrusted;
  row.frozen = (pdu.appearance & pdu::kAppearanceFrozen) != 0;
  row.type = pdu.entity_type;
  row.force_id = pdu.force_id;
  row.appearance = pdu.appearance;
  row.capabilities = pdu.capabilities;
  row.strokes = row.epoch != 0 && row.haptic && row.type.kind == pdu::EntityKind::life_form &&
                deadreckon::drm_terms(heard.state.algorithm).acceleration &&
                !heard.state.acceleration.isZero(0);
  std::copy(pdu.marking.text.begin(), pdu.marking.text.end(), row.marking.begin());
  if (!row.haptic)
    row.timeout = deadreckon::timeout(
        deadreckon::nominal_heartbeat(row.type, deadreckon::stands_still(heard.state)));
}

bool RemoteMotion::is_teleport(const deadreckon::Pose& shown,
                               const deadreckon::Pose& expected) const noexcept {
  const deadreckon::ConvergenceSettings& settings = settings_.convergence.settings;
  const double angle = deadreckon::angle_between(expected.orientation, shown.orientation);
  return !((expected.position - shown.position).norm() <= settings.teleport_distance) ||
         !(angle <= settings.teleport_angle + 1e-9);  // pi may come out an ulp above
}

// The history before an abrupt change does not help to predict the motion after it. A history also
// ends if a better estimate of the sender's clock has reversed the order of its instants.
void RemoteMotion::note_history(RemoteEntity& row, std::size_t place,
                                const deadreckon::Pose& expected, bool abrupt) noexcept {
  const auto sample = deadreckon::motion_sample(*row.state, pdu::to_seconds(row.state_time));
  deadreckon::AdaptiveOrder& order = orders_[place];
  if (!abrupt && row.updates > 0 && order.add(sample, expected)) return;
  deadreckon::AdaptiveSettings settings;
  settings.sent = sent_rates(row.state->algorithm);
  order = deadreckon::AdaptiveOrder(settings);
  static_cast<void>(order.add(sample));
}

void RemoteMotion::note_jump(RemoteEntity& row, const Eigen::Vector3d& before,
                             const Eigen::Vector3d& after) noexcept {
  row.jump_m = (after - before).norm();
  pose_jumps_.add(row.jump_m);
}

void RemoteMotion::note_force_jump(const RemoteEntity& row, const deadreckon::Pose& before,
                                   const deadreckon::Pose& after,
                                   const haptics::ServoSnapshot& servo) noexcept {
  const deadreckon::ProbeState probe{servo.device, servo.device_velocity, settings_.probe_radius};
  const Eigen::Vector3d old_force = deadreckon::evaluate(row.model, before, probe);
  const Eigen::Vector3d new_force = deadreckon::evaluate(row.model, after, probe);
  if (!old_force.isZero() || !new_force.isZero()) force_jumps_.add((new_force - old_force).norm());
}

void RemoteMotion::go_back(RemoteEntity& row, std::size_t place, const HeldState& held,
                           nanoseconds now) noexcept {
  const deadreckon::Pose shown = row.shown(now);
  row.state = held.state;
  row.state_time = held.time;
  row.timestamp = held.timestamp;
  if (is_adaptive_) note_history(row, place, shown, true);
  row.convergence.restart(settings_.convergence.settings, shown, row.expected(now),
                          pdu::to_seconds(now));
}

void RemoteMotion::resume(RemoteEntity& row, nanoseconds now) noexcept {
  const deadreckon::Pose shown = row.shown(now);
  row.doubted_at = RemoteEntity::kTrusted;
  const deadreckon::Pose expected = row.expected(now);
  row.convergence.restart(settings_.convergence.settings, shown, expected, pdu::to_seconds(now));
  if (is_teleport(shown, expected)) snap(row);
}

}  // namespace reckon::peer
