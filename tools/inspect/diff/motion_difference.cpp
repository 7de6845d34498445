// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/diff/motion_difference.hpp"

#include <algorithm>
#include <numbers>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/clocks/seconds.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace

void ReckonedEntities::take(const HeldPdu& pdu) {
  if (!pdu.decoded) return;
  // As relative time: a capture that was replayed or shifted then gives what the original gives.
  HeldPdu relative = pdu;
  relative.octets[7] &= std::byte{0xFE};
  if (pdu.header.pdu_type == pdu::PduType::entity_state) take_state(relative);
  forces_.take(relative.octets, pdu.header, pdu.time);
  if (pdu.ends_datagram) (void)forces_.end_datagram(pdu.time);
}

void ReckonedEntities::take_state(const HeldPdu& held) {
  pdu::EntityState state;
  deadreckon::KinematicState motion;
  if (decode(held.octets, state) != pdu::DecodeError::none ||
      from_wire(state, frame_, motion) != deadreckon::ConversionError::none)
    return;
  if ((state.appearance & pdu::kAppearanceDeactivated) != 0) return table_.erase(state.entity_id);
  bool added = false;
  peer::RemoteEntity* row = table_.find_or_add(state.entity_id, added);
  if (row == nullptr) return;
  const bool runs =
      row->updates == 0 || pdu::difference_units(state.header.timestamp, row->timestamp) > 0;
  const auto stamped = row->clock.local_time(state.header.timestamp, held.time, held.time);
  row->state = motion;
  row->state_time = runs ? stamped.value_or(held.time) : held.time;
  row->timestamp = state.header.timestamp;
  row->last_heard = held.time;
  row->frozen = (state.appearance & pdu::kAppearanceFrozen) != 0;
  row->timeout = deadreckon::timeout(deadreckon::nominal_heartbeat(state.entity_type));
  ++row->updates;
}

void ReckonedEntities::expire(nanoseconds now) {
  for (std::size_t i = 0; i < table_.rows().size();) {
    const peer::RemoteEntity& row = table_.rows()[i];
    if (peer::to_seconds(now - row.last_heard) > row.timeout)
      table_.erase(pdu::EntityId(row.id));
    else
      ++i;
  }
}

void MotionDifference::Side::feed(nanoseconds until) {
  while (has_next && due() <= until) {
    next.time -= shift;
    entities.take(next);
    has_next = stream->next(next);
  }
  entities.expire(until);
}

void MotionDifference::begin(PduStream& a, PduStream& b) {
  a_.stream = &a;
  b_.stream = &b;
  b_.shift = shift_;
  a_.has_next = a.next(a_.next);
  b_.has_next = b.next(b_.next);
  if (!a_.has_next || !b_.has_next) a_.has_next = b_.has_next = false;
  start_ = now_ = std::max(a_.due(), b_.due());
}

bool MotionDifference::advance() {
  if (!a_.has_next && !b_.has_next) return false;
  a_.feed(now_);
  b_.feed(now_);
  compare_poses();
  compare_forces();
  now_ += step_;
  if (!a_.entities.table().rows().empty() && !b_.entities.table().rows().empty()) return true;
  // Nothing to compare before the next arrival.
  nanoseconds arrival = nanoseconds::max();
  for (const Side* side : {&a_, &b_})
    if (side->has_next) arrival = std::min(arrival, side->due());
  if (arrival != nanoseconds::max() && arrival > now_)
    now_ += (arrival - now_ + step_ - nanoseconds(1)) / step_ * step_;
  return true;
}

void MotionDifference::compare_poses() {
  for (const peer::RemoteEntity& row : a_.entities.table().rows()) {
    const peer::RemoteEntity* other = b_.entities.table().find(row.id);
    if (other == nullptr) continue;
    const EntityKey key{row.id.site, row.id.application, row.id.entity};
    if (!poses_.contains(key) && poses_.size() == kMostRows) continue;
    const deadreckon::Pose a = row.predicted(now_);
    const deadreckon::Pose b = other->predicted(now_);
    PoseDifference& difference = poses_[key];
    difference.metres.add((b.position - a.position).norm(), now_ - start_);
    difference.degrees.add(kDegrees * a.orientation.angularDistance(b.orientation), now_ - start_);
  }
}

void MotionDifference::compare_forces() {
  std::map<PairKey, std::array<Eigen::Vector3d, 2>> now;
  const auto collect = [&](Side& side, std::size_t index) {
    for (const ContactForce& found : side.entities.forces().at(now_)) {
      const PairKey key{found.on.site, found.on.application, found.on.entity,
                        found.by.site, found.by.application, found.by.entity};
      const auto place = now.try_emplace(
          key, std::array<Eigen::Vector3d, 2>{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
      place.first->second[index] = found.force;
    }
  };
  collect(a_, 0);
  collect(b_, 1);
  for (const auto& [key, forces] : now) {
    if (!forces_.contains(key) && forces_.size() == kMostRows) continue;
    forces_[key].add((forces[1] - forces[0]).norm(), now_ - start_);
  }
}

}  // namespace reckon::tools
