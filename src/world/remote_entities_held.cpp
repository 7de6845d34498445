// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is kept of entities beside what is shown of them: those outside the radius of interest, and
// what was said to those who are farther away than we are.
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

// Of one outside nothing is kept that its owner does not keep right for those who are so far away.
void RemoteEntities::keep_outside(const Inbound& update, const Arrival& arrival,
                                  const deadreckon::KinematicState& state,
                                  const RemoteEntity* row) noexcept {
  double timeout = deadreckon::timeout(
      deadreckon::nominal_heartbeat(update.state.entity_type, deadreckon::stands_still(state)));
  if (update.has_model) timeout = deadreckon::timeout(deadreckon::kHapticHeartbeat);
  if (!held_.is_on() || arrival.group == aoim::kBaseGroup)
    return outside_.keep({update, arrival, state, timeout});
  if (row == nullptr) return;
  const HeldState& held = held_.behind(table_.place_of(*row), settings_.near_rows - 1);
  if (!held.is_heard) return;
  Inbound told = update;
  told.state.header.timestamp = held.timestamp;
  Arrival then = arrival;
  then.arrival = held.time;
  then.group = aoim::kBaseGroup;
  outside_.keep({told, then, held.state, timeout});
}

void RemoteEntities::note_held(const RemoteEntity& row, const StateInHand& heard, nanoseconds time,
                               bool newest) noexcept {
  if (!held_.is_on()) return;
  held_.note(table_.place_of(row), aoim_.row_of(heard.at.group),
             {heard.state, time, heard.pdu.header.timestamp, heard.at.group, true}, newest);
}

void RemoteEntities::leave_groups(std::span<const aoim::GroupIndex> groups,
                                  nanoseconds now) noexcept {
  for (const aoim::GroupIndex group : groups) {
    if (!aoim_.is_near_group(group)) continue;
    held_.leave(group, aoim_.row_of(group),
                [&](std::size_t place, const HeldState& held) { go_back(place, held, now); });
  }
}

// Without a jump, as with any update.
void RemoteEntities::go_back(std::size_t place, const HeldState& held, nanoseconds now) noexcept {
  RemoteEntity& row = table_.rows()[place];
  const deadreckon::Pose shown = row.shown(now);
  row.state = held.state;
  row.state_time = held.time;
  row.timestamp = held.timestamp;
  if (is_adaptive()) note_history(row, shown, true);
  row.convergence.restart(settings_.convergence.settings, shown, row.expected(now),
                          pdu::to_seconds(now));
  ++row.version;
  near_.note_update(place);
  changes_.updated(place);
}

}  // namespace reckon::peer
