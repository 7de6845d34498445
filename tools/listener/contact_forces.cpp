// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/peer/clocks/seconds.hpp"

namespace reckon::tools {
namespace {

using deadreckon::ConversionError;
using pdu::DecodeError;
using pdu::ForceModelKind;
using std::chrono::nanoseconds;

/// Entities of one datagram whose jumps are told; a bundle below the MTU holds fewer.
constexpr std::size_t kMostTouched = 128;

}  // namespace

deadreckon::LocalFrame local_frame_at(const Eigen::Vector3d& position) {
  // Bowring: within 1e-9 rad up to satellites, which is all that axes need.
  constexpr double kEquator = 6378137.0;
  constexpr double kFlattening = 1 / 298.257223563;
  constexpr double kPole = kEquator * (1 - kFlattening);
  constexpr double kSquared = kFlattening * (2 - kFlattening);
  constexpr double kSecondSquared = kSquared / (1 - kSquared);
  const double axis = std::hypot(position.x(), position.y());
  const double angle = std::atan2(position.z() * kEquator, axis * kPole);
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const double latitude =
      std::atan2(position.z() + kSecondSquared * kPole * sine * sine * sine,
                 std::max(0.0, axis - kSquared * kEquator * cosine * cosine * cosine));
  const double up = std::sin(latitude);
  const double height =
      axis * std::cos(latitude) + position.z() * up - kEquator * std::sqrt(1 - kSquared * up * up);
  return {latitude, std::atan2(position.y(), position.x()), std::clamp(height, -1e8, 1e8)};
}

ContactForces::ContactForces() : table_(kMostEntities) { touched_.reserve(kMostTouched); }

void ContactForces::take(std::span<const std::byte> pdu, const pdu::PduHeader& header,
                         nanoseconds time) {
  if (header.pdu_type == pdu::PduType::entity_state) {
    pdu::EntityState state;
    if (decode(pdu, state) == DecodeError::none) take_state(state, time);
  }
  if (header.pdu_type != pdu::PduType::attribute) return;
  pdu::Attribute attribute;
  if (decode(pdu, attribute) != DecodeError::none) return;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    for (const pdu::AttributeRecord& record : set.records()) {
      pdu::HapticRecord model;
      pdu::EnergyAccountRecord account;
      if (decode(record, model) == DecodeError::none)
        take_record(set.entity_id, model);
      else if (decode(record, account) == DecodeError::none)
        take_account(set.entity_id, account);
    }
  }
}

const deadreckon::LocalFrame* ContactForces::frame_for(const pdu::WorldCoordinates& location) {
  const Eigen::Vector3d position(location.x, location.y, location.z);
  if (!frame_.has_value() && position.allFinite() &&
      position.norm() <= deadreckon::kLargestLocation)
    frame_ = local_frame_at(position);
  return frame_.has_value() ? &*frame_ : nullptr;
}

ContactForces::Touched& ContactForces::touch(const pdu::EntityId& id) {
  const auto known = std::ranges::find(touched_, id, &Touched::id);
  if (known != touched_.end()) return *known;
  // Beyond the room the last place is used anew: its jump is not told, nothing else is lost.
  if (touched_.size() == kMostTouched) touched_.pop_back();
  Touched& touched = touched_.emplace_back();
  touched.id = id;
  if (const peer::RemoteEntity* row = table_.find(id)) {
    touched.known = true;
    touched.before = *row;
  }
  return touched;
}

void ContactForces::take_state(const pdu::EntityState& state, nanoseconds time) {
  if ((state.appearance & pdu::kAppearanceDeactivated) != 0) return forget(state.entity_id);
  peer::RemoteEntity* row = table_.find(state.entity_id);
  if (row == nullptr && !state.header.coupled_extension()) return;
  expire(time);
  Touched& touched = touch(state.entity_id);
  bool added = false;
  row = table_.find_or_add(state.entity_id, added);
  if (row == nullptr) {
    ++refusals_.crowded;
    touched.refused = true;
    return;
  }
  if (added) row->first_heard = time;
  refresh(*row, state, touched, time);
  if (row->updates == 0) table_.erase(state.entity_id);  // its first state was refused
}

// As src/remote_entities does it: what a peer refuses is refused here.
void ContactForces::refresh(peer::RemoteEntity& row, const pdu::EntityState& state,
                            Touched& touched, nanoseconds time) {
  const deadreckon::LocalFrame* frame = frame_for(state.location);
  deadreckon::KinematicState motion;
  touched.refused = true;
  if (frame == nullptr || from_wire(state, *frame, motion) != ConversionError::none) {
    ++refusals_.values;
    return;
  }
  const auto stamped = row.clock.local_time(state.header.timestamp, time, time);
  if (!stamped.has_value()) {
    ++refusals_.stale;
    return;
  }
  touched.refused = false;
  row.state = motion;
  row.state_time = *stamped;
  row.timestamp = state.header.timestamp;
  row.last_heard = time;
  row.frozen = (state.appearance & pdu::kAppearanceFrozen) != 0;
  row.type = state.entity_type;
  std::copy(state.marking.text.begin(), state.marking.text.end(), row.marking.begin());
  if (!row.haptic) row.timeout = deadreckon::timeout(deadreckon::nominal_heartbeat(row.type));
  ++row.updates;
}

void ContactForces::take_record(const pdu::EntityId& id, const pdu::HapticRecord& record) {
  if (touch(id).refused) return;
  peer::RemoteEntity* row = table_.find(id);
  if (row == nullptr) {
    ++refusals_.unplaced;
    return;
  }
  deadreckon::ForceModel model;
  if (deadreckon::from_wire(record, model) != ConversionError::none) {
    ++refusals_.values;
    return;
  }
  row->model = model;
  row->haptic = true;
  row->timeout = deadreckon::timeout(deadreckon::kHapticHeartbeat);
  row->valid_until = row->last_heard + peer::from_seconds(model.validity);
  ++row->version;
}

ContactForces::AccountKey ContactForces::key(const pdu::EntityId& from,
                                             const pdu::EntityId& to) noexcept {
  return {from.site, from.application, from.entity, to.site, to.application, to.entity};
}

void ContactForces::take_account(const pdu::EntityId& id, const pdu::EnergyAccountRecord& record) {
  const ToldEnergy told{record.given, static_cast<double>(record.need)};
  if (!std::isfinite(told.given) || !std::isfinite(told.need)) {
    ++refusals_.values;
    return;
  }
  const auto place = accounts_.find(key(id, record.counterpart));
  if (place != accounts_.end())
    place->second = told;
  else if (accounts_.size() < kMostAccounts)
    accounts_.emplace(key(id, record.counterpart), told);
  else
    ++refusals_.crowded;
}

ToldEnergy ContactForces::told_energy(const pdu::EntityId& from,
                                      const pdu::EntityId& to) const noexcept {
  const auto place = accounts_.find(key(from, to));
  return place == accounts_.end() ? ToldEnergy{} : place->second;
}

ToldEnergy ContactForces::told_energy(const pdu::EntityId& from) const noexcept {
  ToldEnergy sum;
  for (auto place = accounts_.lower_bound(key(from, {0, 0, 0}));
       place != accounts_.end() && place->first <= key(from, {0xFFFF, 0xFFFF, 0xFFFF}); ++place) {
    sum.given += place->second.given;
    sum.need += place->second.need;
  }
  return sum;
}

void ContactForces::forget(const pdu::EntityId& id) {
  if (table_.find(id) == nullptr) return;
  table_.erase(id);
  std::erase_if(touched_, [&](const Touched& touched) { return touched.id == id; });
}

void ContactForces::expire(nanoseconds time) {
  // Erasing moves the last row into the hole, so the same place is looked at again.
  for (std::size_t i = 0; i < table_.rows().size();) {
    const peer::RemoteEntity& row = table_.rows()[i];
    if (peer::to_seconds(time - row.last_heard) > row.timeout)
      forget(pdu::EntityId(row.id));
    else
      ++i;
  }
}

ContactForces::Placed ContactForces::place(const peer::RemoteEntity& row, nanoseconds time) {
  Placed placed{&row,
                row.predicted(time),
                {},
                false,
                row.haptic && time <= row.valid_until,
                row.model.radius};
  const bool is_ball = row.model.kind == ForceModelKind::sphere;
  placed.is_probe = row.haptic && (is_ball || row.model.kind == ForceModelKind::field);
  if (!placed.is_probe) placed.reach = std::numeric_limits<double>::infinity();
  // The ball of a hand is where its device is: the model's point, not the body's origin (SCP).
  placed.probe = {placed.pose.position + placed.pose.orientation * row.model.point,
                  placed.pose.velocity, is_ball ? row.model.radius : 0.0};
  return placed;
}

bool ContactForces::may_touch(const Placed& on, const Placed& by) {
  const double reach = by.reach + on.probe.radius;
  return on.is_probe && by.is_valid &&
         (on.probe.position - by.probe.position).squaredNorm() <= reach * reach;
}

ContactForce ContactForces::between(const Placed& on, const Placed& by) {
  ContactForce out{on.row->id, by.row->id, 0.0, Eigen::Vector3d::Zero()};
  if (!may_touch(on, by)) return out;
  const deadreckon::ForceModel& model = by.row->model;
  out.depth = deadreckon::contact(model, by.pose, on.probe.position, on.probe.radius).depth;
  out.force = deadreckon::evaluate(model, by.pose, on.probe);
  return out;
}

std::span<const ContactForce> ContactForces::at(nanoseconds time) {
  expire(time);
  placed_.clear();
  forces_.clear();
  for (const peer::RemoteEntity& row : table_.rows())
    if (row.haptic) placed_.push_back(place(row, time));
  for (const Placed& on : placed_) {
    if (!on.is_probe) continue;
    for (const Placed& by : placed_) {
      if (&on == &by || !may_touch(on, by)) continue;
      const ContactForce force = between(on, by);
      if (force.depth > 0) forces_.push_back(force);
    }
  }
  return forces_;
}

Eigen::Vector3d ContactForces::force_on(const pdu::EntityId& id, nanoseconds time) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const peer::RemoteEntity* row = table_.find(id);
  if (row == nullptr || !row->haptic) return sum;
  const Placed on = place(*row, time);
  for (const peer::RemoteEntity& other : table_.rows())
    if (other.haptic && &other != row) sum += between(on, place(other, time)).force;
  return sum;
}

std::span<const ForceJump> ContactForces::end_datagram(nanoseconds time) {
  jumps_.clear();
  updated_.clear();
  for (const Touched& touched : touched_) updated_.push_back(touched.id);
  for (const Touched& touched : touched_)
    if (touched.known && !touched.refused && touched.before.haptic) note_jumps(touched, time);
  touched_.clear();
  return jumps_;
}

void ContactForces::note_jumps(const Touched& touched, nanoseconds time) {
  const peer::RemoteEntity* row = table_.find(touched.id);
  if (row == nullptr) return;
  const Placed before = place(touched.before, time);
  const Placed after = place(*row, time);
  const auto note = [&](const ContactForce& was, const ContactForce& is) {
    if (was.depth > 0 || is.depth > 0)
      jumps_.push_back({is.on, is.by, (is.force - was.force).norm()});
  };
  for (const peer::RemoteEntity& other : table_.rows()) {
    if (!other.haptic || other.id == touched.id) continue;
    const Placed there = place(other, time);
    note(between(before, there), between(after, there));
    note(between(there, before), between(there, after));
  }
}

}  // namespace reckon::tools
