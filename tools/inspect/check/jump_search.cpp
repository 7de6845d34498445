// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/jump_search.hpp"

#include <algorithm>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

using deadreckon::KinematicState;

constexpr double kLeastExplained = 5.0;       // senders' thresholds are smaller [m]
constexpr double kTimeError = 0.1;            // of a position against its timestamp [s]
constexpr double kHiddenAcceleration = 10.0;  // [m/s^2] not visible in updates,
constexpr double kLongestHidden = 5.0;        // and its longest duration [s]
constexpr double kMostAcceleration = 150.0;   // limit of a plausible change of velocity
constexpr double kSimilar = 3.0;              // ratio of speeds
constexpr double kUnstatedMargin = 2.0;       // factor of the unstated speed

Eigen::Vector3d velocity_of(const KinematicState& state) {
  const bool body = deadreckon::drm_terms(state.algorithm).body_axes;
  return body ? Eigen::Vector3d(state.orientation * state.velocity) : state.velocity;
}

/// Whether no body could have both velocities in this interval.
bool is_wild(const KinematicState& before, const KinematicState& now, double interval) {
  const double change = (velocity_of(now) - velocity_of(before)).norm();
  return change > kMostAcceleration * std::max(interval, 1.0);
}

/// By timestamps, even if they run faster than the arrivals (a replay without pauses).
std::optional<double> stated_interval(const ReceivedEntity& last, const StateUpdate& update) {
  const std::uint32_t before = timestamp_of(last.octets);
  const std::uint32_t now = timestamp_of(update.octets);
  if (pdu::is_absolute(before) != pdu::is_absolute(now)) return std::nullopt;
  const double stated = pdu::to_seconds(pdu::difference(now, before));
  return stated > 0 ? std::optional(stated) : std::nullopt;
}

}  // namespace

/// Called by the listener for each state of the present PDU.
struct JumpSearch::Observer : ListenerObserver {
  Observer(JumpSearch& the_search, const PduRow& the_pdu, const peer::SourceDatagram& the_datagram,
           const Tell& the_tell)
      : search(the_search), pdu(the_pdu), datagram(the_datagram), tell(the_tell) {}

  void receive_state(const StateUpdate& update) {
    if (update.place >= search.rows_.size()) search.rows_.resize(update.place + 1);
    if (update.verdict != ReceiveVerdict::taken) return;
    Row& row = search.rows_[update.place];
    const bool other_sender = datagram.source != row.sender;
    row.sender = datagram.source;
    if (update.is_first) {
      drop_suspect(row, tell);
      row.spike.reset();
      return;
    }
    // Two senders with one ID, or a restarted program: no jump of one entity.
    if (other_sender) {
      row.suspect.reset();
      return;
    }
    Jump here;
    here.id = update.pdu->entity_id;
    here.frame = pdu.frame;
    here.pdu = pdu.pdu;
    here.offset = pdu.offset;
    here.is_entity_state = pdu.entity_state != nullptr;
    here.time = pdu.time;
    search.compare(row, update, here, tell);
  }

  JumpSearch& search;
  const PduRow& pdu;
  const peer::SourceDatagram& datagram;
  const Tell& tell;
};

JumpSearch::JumpSearch(std::size_t most_entities)
    : heard_([&] {
        ListenerRules rules = kMonitorRules;
        rules.most_entities = most_entities;
        return rules;
      }()) {}

void JumpSearch::take_pdu(const PduRow& row, const peer::SourceDatagram& datagram,
                          const Tell& tell) {
  Observer observer(*this, row, datagram, tell);
  heard_.take_pdu(row.bytes, row.header, datagram.time, observer, row.entity_state);
}

void JumpSearch::finish(const Tell& tell) {
  for (Row& row : rows_) drop_suspect(row, tell);
}

double JumpSearch::explained(const KinematicState& before, const KinematicState& now,
                             double interval) {
  const Eigen::Vector3d velocity = velocity_of(before);
  const double change =
      std::min((velocity_of(now) - velocity).norm(), kMostAcceleration * interval);
  const double acceleration =
      std::clamp(std::max(before.acceleration.norm(), now.acceleration.norm()), kHiddenAcceleration,
                 kMostAcceleration);
  // With equal velocities at both ends, a body that accelerates for half of the time and brakes for
  // the other half ends a t^2 / 4 from the straight line.
  const double hidden = std::min(interval, kLongestHidden);
  return kLeastExplained + kTimeError * velocity.norm() + 0.5 * change * interval +
         0.25 * acceleration * hidden * hidden;
}

JumpSearch::Fit JumpSearch::fit(const KinematicState& before, const KinematicState& now,
                                const Intervals& passed, double unstated_speed) {
  Fit best;
  bool first = true;
  for (const double interval : passed) {
    const double extrapolated =
        (now.position - deadreckon::extrapolate(before, interval).position).norm();
    const Eigen::Vector3d mean = 0.5 * (velocity_of(before) + velocity_of(now));
    const double off =
        std::min(extrapolated, (now.position - before.position - interval * mean).norm());
    const Fit one{off,
                  explained(before, now, interval) + kUnstatedMargin * unstated_speed * interval,
                  extrapolated, interval};
    if (first || one.off - one.allowed < best.off - best.allowed) best = one;
    first = false;
  }
  return best;
}

void JumpSearch::compare(Row& row, const StateUpdate& update, const Jump& here, const Tell& tell) {
  const ReceivedEntity& last = heard_.entities()[update.place];
  const double arrived = std::max(last.age(update.arrival), 0.0);
  const Intervals passed{stated_interval(last, update).value_or(arrived), arrived};
  if (row.suspect != nullptr) return decide(row, update, passed, here, tell);
  if (row.spike != nullptr) {
    for (std::size_t i = 0; i < passed.size(); ++i) row.spike->ago[i] += passed[i];
    ++row.spike->updates;
  }
  const Fit found = fit(last.state, update.state, passed, row.unstated_speed);
  if (!found.is_explained()) return suspect(row, last.state, passed, found, update.state, here);
  if (row.unstated_speed > 0 && fit(last.state, update.state, passed).is_explained())
    row.unstated_speed = 0;
}

void JumpSearch::suspect(Row& row, const KinematicState& before, const Intervals& passed,
                         const Fit& fit, const KinematicState& now, const Jump& here) {
  row.suspect = std::make_unique<Suspect>(Suspect{before, passed, here});
  row.suspect->jump.metres = fit.metres;
  row.suspect->jump.degrees = deadreckon::in_degrees(deadreckon::angle_between(
      now.orientation, deadreckon::extrapolate(before, fit.interval).orientation));
  row.suspect->jump.explained = fit.allowed;
  row.suspect->jump.interval = passed[0];
}

// Classifies a suspect by the next update: it continues the update before the suspect (a spike), or
// the suspect (a teleport), or the entity moves at a speed that it does not state.
void JumpSearch::decide(Row& row, const StateUpdate& update, const Intervals& passed,
                        const Jump& here, const Tell& tell) {
  const KinematicState& there = heard_.entities()[update.place].state;
  const Suspect& doubted = *row.suspect;
  Intervals both;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = doubted.since[i] + passed[i];
  KinematicState from = there;
  if (from.algorithm == doubted.before.algorithm && is_wild(doubted.before, from, doubted.since[0]))
    from.velocity = doubted.before.velocity;

  const Fit stayed = fit(from, update.state, passed, row.unstated_speed);
  const Fit returned = fit(doubted.before, update.state, both, row.unstated_speed);
  if (returned.is_explained() && (!stayed.is_explained() || returned.off < stayed.off))
    return tell_spike(row, there, passed, tell);
  if (stayed.is_explained()) return drop_suspect(row, tell);

  const Eigen::Vector3d first = there.position - doubted.before.position;
  const Eigen::Vector3d second = update.state.position - there.position;
  const double first_speed = first.norm() / std::max(doubted.since[0], 1e-3);
  const double second_speed = second.norm() / std::max(passed[0], 1e-3);
  const bool goes_on = first.dot(second) > 0 && first_speed < kSimilar * second_speed &&
                       second_speed < kSimilar * first_speed;
  if (goes_on) {
    row.unstated_speed = std::max(first_speed, second_speed);
    row.suspect.reset();
    return;
  }
  drop_suspect(row, tell);
  suspect(row, from, passed, stayed, update.state, here);
}

void JumpSearch::tell_spike(Row& row, const KinematicState& state, const Intervals& passed,
                            const Tell& tell) {
  const LastSpike* last = row.spike.get();
  const bool again =
      last != nullptr && last->updates == 1 && fit(last->state, state, last->ago).is_explained();
  Jump jump = row.suspect->jump;
  row.suspect.reset();
  jump.kind = again ? Jump::Kind::by_turns : Jump::Kind::spike;
  if (!row.by_turns) tell(jump);
  row.by_turns = row.by_turns || again;
  row.spike = std::make_unique<LastSpike>(LastSpike{state, passed});
}

void JumpSearch::drop_suspect(Row& row, const Tell& tell) {
  if (row.suspect == nullptr) return;
  const Jump jump = row.suspect->jump;
  row.suspect.reset();
  if (!row.by_turns) tell(jump);
}

}  // namespace reckon::tools
