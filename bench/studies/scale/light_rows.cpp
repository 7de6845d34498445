// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/light_rows.hpp"

#include <algorithm>
#include <memory>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/audiences.hpp"

namespace reckon::bench {
namespace {

constexpr std::chrono::milliseconds kLookAgain{100};  // who is near, as peers do

}  // namespace

using deadreckon::SendReason;

void LightRows::set_tiers(LightEntity& entity, const deadreckon::KinematicState& state, double told,
                          SendReason reason, double first_heartbeat) const {
  entity.audiences = std::make_unique<peer::Audiences>(
      false, channels_.audiences(), entity.policy, deadreckon::kDefaultSendRule, first_heartbeat);
  const std::size_t all = entity.audiences->last();
  do entity.audiences->note_sent(all, state, told, reason, true);
  while (reason == SendReason::heartbeat &&
         entity.audiences->next(all) - told <
             0.99 * entity.policy.heartbeat() - entity.policy.step());
}

// The near row of which somebody asks for the entity; near_rows() where nobody does.
std::size_t LightRows::asked_row(const LightEntity& entity, const Looked& at, double time) const {
  const peer::Audiences& audiences = *entity.audiences;
  for (std::size_t row = near_rows(); world_.introduction.is_pending() && row-- > 0;) {
    const double told = row == 0 ? entity.told : audiences.last_sent_at(row);
    if (audiences.is_behind(row + 1) &&
        world_.introduction.is_due(at.id, group(row, at.cell), pdu::from_seconds(told),
                                   pdu::from_seconds(time)))
      return row;
  }
  return near_rows();
}

LightRows::Due LightRows::consider(LightEntity& entity, const Looked& at, double time) {
  peer::Audiences& audiences = *entity.audiences;
  const auto now = pdu::from_seconds(time);
  if (at.is_asked) audiences.event(audiences.last());
  if (audiences.has_to_look(now))
    audiences.serve(world_.others.served_row(at.entity, world_.crowd, audiences.slack()),
                    now + kLookAgain);
  const std::size_t row = asked_row(entity, at, time);
  if (row < near_rows()) {
    entity.policy.event();
    audiences.event(row);
    audiences.serve(std::min(row, audiences.served_row()), now + peer::Audiences::kGrace);
  }
  const deadreckon::MotionSample truth = world_.crowd.motion(at.entity);
  Due due =
      choose(entity, {truth.position, truth.orientation, truth.velocity, truth.angular_velocity},
             time, world_.crowd.speed(at.entity) > 0);
  due.is_patient = !at.is_asked && row == near_rows();
  return due;
}

LightRows::Due LightRows::choose(const LightEntity& entity, const deadreckon::Pose& truth,
                                 double time, bool moves) const {
  const peer::Audiences& audiences = *entity.audiences;
  Due due;
  for (std::size_t row = audiences.last() + 1; row-- > 0;) {
    SendReason reason =
        row == 0 ? entity.policy.decide(truth, time) : audiences.decide(row, truth, time);
    const auto told = [&](std::size_t to) {
      return to == 0 ? entity.told : audiences.last_sent_at(to);
    };
    if (reason == SendReason::none && row > 0 && audiences.is_out_of_step(row, told(row - 1), time))
      reason = SendReason::heartbeat;
    if (reason == SendReason::none || row < audiences.served()) continue;
    const bool by_distance = reason == SendReason::position || reason == SendReason::orientation;
    const aoim::Channel& channel = channels_.audiences()[row];
    const bool rests =
        !moves && !peer::is_shown_moving(entity.policy, entity.audiences.get(), row, time);
    const double rate = rests ? channel.passive_hz : channel.active_hz;
    if (by_distance && time - told(row) < 1 / rate) continue;
    const bool is_outmost = due.reason == SendReason::none;
    if (is_outmost) due.row = row;
    due.reason = is_outmost ? reason : std::min(due.reason, reason);
  }
  return due;
}

}  // namespace reckon::bench
