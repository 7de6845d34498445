// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/shared_bodies.hpp"

#include <algorithm>
#include <utility>

namespace reckon::peer {
namespace {

using Eigen::Quaterniond;
using std::chrono::nanoseconds;

constexpr std::uint8_t kCategory = 0x42;
// Time functions start again after some 12 days, so that a double represents their time to 0.1 ns.
constexpr nanoseconds kAge = std::chrono::seconds(1 << 20);

// Forward, right and down from x, y and z.
const Quaterniond kLevel(0.0, 1.0, 0.0, 0.0);

}  // namespace

pdu::EntityType body_type(std::size_t body) noexcept {
  pdu::EntityType type{};
  type.category = kCategory;
  type.extra = static_cast<std::uint8_t>(body);
  return type;
}

std::optional<std::size_t> body_of(const pdu::EntityType& type) noexcept {
  const std::size_t body = type.extra;
  if (body >= kMostSharedBodies || type != body_type(body)) return std::nullopt;
  return body;
}

pdu::EntityId body_id(std::size_t body) noexcept {
  return {aoim::kSceneId.site, aoim::kSceneId.application, static_cast<std::uint16_t>(body + 1)};
}

EntityTruth truth_of(const haptics::BodyState& body, nanoseconds time) noexcept {
  EntityTruth truth;
  truth.time = time;
  truth.position = body.position;
  truth.orientation = body.orientation * kLevel;
  truth.velocity = body.velocity;
  truth.angular_velocity = truth.orientation.conjugate() * body.turn_rate;
  return truth;
}

haptics::ObjectMotion motion_of(const deadreckon::Pose& shown) noexcept {
  haptics::ObjectMotion motion;
  motion.position = shown.position;
  motion.orientation = shown.orientation * kLevel.conjugate();
  motion.velocity = shown.velocity;
  motion.turn_rate = shown.orientation * shown.angular_velocity;
  return motion;
}

BodyMover::BodyMover(const haptics::EffectPlan& plan, const SceneNodes& nodes)
    : graph_(nodes.graph) {
  for (std::uint32_t i = 0; i < plan.objects().size(); ++i) {
    const haptics::PlannedObject& object = plan.objects()[i];
    if (!object.moves()) continue;
    Body& body = bodies_.emplace_back();
    body.object = i;
    const auto moved = std::ranges::find(nodes.moved, i, &MovedObject::object);
    if (moved != nodes.moved.end()) body.node = moved->node;
    body.last.orientation = object.orientation;
    body.last.position = object.position - object.orientation * object.origin;
  }
}

haptics::ObjectMotion BodyMover::motion_of(std::uint32_t object, nanoseconds now) noexcept {
  (void)shown_.update();
  const auto found = std::ranges::find(bodies_, object, &Body::object);
  if (found == bodies_.end()) return {};
  if (found->node != kNoNode) return by_time(found->node, now);
  const auto place = static_cast<std::size_t>(found - bodies_.begin());
  const ShownBodies& shown = shown_.read();
  haptics::ObjectMotion& last = found->last;
  if (found->left && *found->left != shown.rows[place].entity().version) found->left.reset();
  if (found->left || place >= shown.rows.size() || shown.known[place] != ShownBodies::Known::here) {
    last.velocity.setZero();
    last.turn_rate.setZero();
    return last;
  }
  // The convergence of a shown pose strikes nothing.
  deadreckon::Pose pose = shown.rows[place].shown(now);
  const deadreckon::Pose predicted = shown.rows[place].entity().predicted(now);
  pose.velocity = predicted.velocity;
  pose.angular_velocity = predicted.angular_velocity;
  return last = peer::motion_of(pose);
}

void BodyMover::leave_at(std::uint32_t object, const haptics::ObjectMotion& motion) noexcept {
  (void)shown_.update();
  const auto found = std::ranges::find(bodies_, object, &Body::object);
  if (found == bodies_.end()) return;
  const auto place = static_cast<std::size_t>(found - bodies_.begin());
  found->last = motion;
  found->left = shown_.read().rows[place].entity().version;
}

haptics::ObjectMotion BodyMover::by_time(NodeIndex node, nanoseconds now) noexcept {
  if (std::exchange(evaluated_, now) != now)
    graph_.evaluate((now + offset_.load(std::memory_order_relaxed)) % kAge);
  const NodePose& pose = graph_.world(node);
  const NodeVelocity& velocity = graph_.velocity(node);
  haptics::ObjectMotion out;
  out.position = pose.position;
  out.orientation = pose.orientation;
  out.velocity = velocity.linear;
  out.turn_rate = velocity.angular;
  return out;
}

std::optional<std::size_t> RemoteBodies::number_of(const RemoteEntity& row,
                                                   const RemoteEntities& rows) const noexcept {
  if (interop_) return body_of(row.type);
  if (!rows.bodies().contains(row.id)) return std::nullopt;
  return row.id.entity - 1u;
}

void RemoteBodies::note(const Inbound& update, const Arrival& arrival,
                        RemoteEntities& rows) noexcept {
  const RemoteEntity* row = rows.find(update.entity);
  const auto body = row == nullptr ? std::nullopt : number_of(*row, rows);
  if (!body) return;
  Place& place = places_[*body];
  if (!takes(*row, arrival, rows)) {
    if (place.id == update.entity) lose(*body);
    return;
  }
  if (place.id != update.entity) place = {update.entity, row->version - 1, row->doubted_at};
}

void RemoteBodies::note_own(const pdu::EntityId& body, const RemoteEntities& rows) noexcept {
  const RemoteEntity* row = rows.find(body);
  if (row != nullptr) places_[body.entity - 1u] = {body, row->version - 1, row->doubted_at};
}

bool RemoteBodies::takes(const RemoteEntity& row, const Arrival& arrival,
                         RemoteEntities& rows) const noexcept {
  const aoim::PeerId owner = rows.bodies().owner_of(row);
  const bool named = !interop_ || rows.touch().names(owner);
  if (named && rows.touch().admits(owner, arrival.epoch != 0, arrival.from)) return true;
  return rows.refuse_touch(row), false;
}

void RemoteBodies::lose(std::size_t body) noexcept {
  newest_.known[body] = ShownBodies::Known::gone;
  places_[body] = {};
  changed_ = true;
}

void RemoteBodies::publish(const RemoteEntities& rows) noexcept {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Place& place = places_[i];
    if (!place.id) continue;
    const RemoteEntity* row = rows.find(*place.id);
    if (row == nullptr) {
      lose(i);
    } else if (newest_.known[i] != ShownBodies::Known::here || place.version != row->version ||
               place.doubted_at != row->doubted_at) {
      newest_.rows[i] = RemoteCopy(*row);
      newest_.known[i] = ShownBodies::Known::here;
      place.version = row->version;
      place.doubted_at = row->doubted_at;
      changed_ = true;
    }
  }
  if (!std::exchange(changed_, false)) return;
  shown_.write_slot() = newest_;
  shown_.publish();
}

}  // namespace reckon::peer
