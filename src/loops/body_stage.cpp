// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/body_stage.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

namespace {

constexpr double kLongestStep = 0.02;  // [s] over which an acceleration is known
constexpr double kMostSteady = 12.0;   // [m/s^2]; a knock has more
constexpr double kFalls = 0.5;         // [m/s^2], difference from gravity
constexpr double kKnock = 0.02;        // [m/s], a change of velocity that is sent at once
constexpr int kMostWaits = 2;          // steps of 1 ms

}  // namespace

BodyStage::BodyStage(const ModelWiring& wiring)
    : scene_(wiring.scene),
      frame_(wiring.frame),
      own_(wiring.bodies == nullptr ? nullptr : &wiring.bodies->outgoing()),
      stepped_(wiring.stepped),
      mover_(wiring.mover) {
  std::size_t moving = 0;
  for (const haptics::SceneObject& object : scene_.scene.objects) {
    const bool is_body = object.matter.mass > 0 && !object.carried;
    if (!is_body && !object.carried) continue;
    if (is_body && moving < kMostSharedBodies) bodies_.push_back({moving, &object});
    ++moving;
  }
  if (mover_ != nullptr) remote_.emplace(mover_->shown(), scene_.network.interop);
}

EntityDescription BodyStage::description_of(const haptics::SceneObject& object,
                                            std::size_t number) const {
  EntityDescription description;
  description.marking = object.name;
  description.type = body_type(number);
  description.dead_reckoning = scene_.dead_reckoning;
  return description;
}

void BodyStage::add_own(EntityNumber first, OwnedEntities& owned) {
  first_ = first;
  for (const Body& body : bodies_) {
    const auto number = static_cast<EntityNumber>(first + body.number);
    const EntityDescription description = description_of(*body.object, body.number);
    if (scene_.network.interop)
      static_cast<void>(owned.add(number, description));
    else
      static_cast<void>(owned.add_body(number, description, body_id(body.number), {}));
  }
}

// A new owner states its body at once: only then the others accept it as the owner's.
bool BodyStage::set_own(std::size_t body, const pdu::OwnershipRecord& ownership,
                        OwnedEntities& owned) noexcept {
  OwnedEntity* entity = entity_of(body, owned);
  if (entity == nullptr || !entity->is_body()) return false;
  const pdu::OwnershipRecord& last = *entity->ownership();
  const bool is_same = last.owner == ownership.owner && last.version == ownership.version &&
                       last.world == ownership.world;
  if (is_same) return false;
  const bool begins = last.owner == 0;
  entity->own_by(ownership);
  if (ownership.owner == 0) return false;
  stated_[body].reset();
  entity->event();
  owned.look_at(static_cast<EntityNumber>(first_ + body));
  is_fresh_ = true;
  return begins;
}

void BodyStage::leave(const haptics::BodyEnd& end, const Pass& pass,
                      const pdu::OwnershipRecord& ownership, OwnedEntities& owned,
                      RemoteEntities& remote) noexcept {
  OwnedEntity* entity = entity_of(end.body, owned);
  if (entity == nullptr) return;
  haptics::BodyState state;
  static_cast<haptics::ObjectMotion&>(state) = end.state;
  static_cast<void>(entity->move(truth_of(state, end.time)));
  EntityUpdate update;
  const nanoseconds utc = pass.utc - (pass.now - end.time);
  if (!entity->build(end.time, utc, deadreckon::SendReason::event, {}, update)) return;
  Inbound own;
  own.entity = entity->id();
  own.has_state = true;
  own.state = update.state;
  own.ownership = ownership;
  Arrival arrival;
  arrival.now = arrival.arrival = pass.now;
  arrival.utc = pass.utc;
  arrival.epoch = ownership.owner;
  arrival.clock.ahead = nanoseconds(0);
  if (remote.take(own, arrival, {}) && remote_) remote_->note_own(own.entity, remote);
}

void BodyStage::note_place(std::size_t body, const pdu::EntityState& state) noexcept {
  deadreckon::KinematicState motion;
  const bool is_good =
      deadreckon::from_wire(state, frame_, motion) == deadreckon::ConversionError::none;
  if (is_good && body < stated_.size()) stated_[body] = Stated{motion.position, motion.orientation};
}

haptics::ObjectMotion BodyStage::motion_now(std::size_t body, const RemoteEntities& remote,
                                            nanoseconds now) const noexcept {
  const RemoteEntity* row = remote.find(body_id(body));
  if (row != nullptr) {
    deadreckon::Pose pose = row->predicted(now);
    const deadreckon::Pose shown = row->shown(pose, now);
    pose.position = shown.position;
    pose.orientation = shown.orientation;
    return motion_of(pose);
  }
  haptics::ObjectMotion motion = states()->bodies[body];
  if (!stated_[body]) return motion;
  deadreckon::Pose pose;
  pose.position = stated_[body]->position;
  pose.orientation = stated_[body]->orientation;
  return motion_of(pose);
}

void BodyStage::read(nanoseconds now, const OwnedEntities& owned) noexcept {
  if (stepped_ != nullptr && !bodies_.empty()) {
    const auto number = static_cast<EntityNumber>(first_ + bodies_.front().number);
    const OwnedEntity* first = owned.find(number);
    stepped_->step(now, first != nullptr && first->is_frozen());
  }
  if (own_ == nullptr || !own_->update()) return;
  is_fresh_ = true;
  note_motions();
}

void BodyStage::note_motions() noexcept {
  const haptics::BodyStates& states = own_->read();
  const double step = pdu::to_seconds(states.time - read_at_);
  const bool is_known = step > 0.0 && step < kLongestStep;
  read_at_ = states.time;
  for (std::size_t i = 0; i < std::min(states.bodies.size(), motions_.size()); ++i) {
    const haptics::BodyState& body = states.bodies[i];
    Motion& motion = motions_[i];
    if (!body.is_owned() || (!body.awake && motion.acceleration.isZero(0))) continue;
    const Eigen::Vector3d change = body.velocity - motion.velocity;
    const bool is_knock = is_known && change.norm() > kKnock + kMostSteady * step;
    const bool is_steady = is_known && body.awake && change.norm() < kMostSteady * step;
    // The state after a knock waits for its acceleration.
    motion.is_due = motion.is_due || (motion.waits > 0 && (is_steady || --motion.waits == 0));
    if (is_knock && motion.waits == 0) motion.waits = kMostWaits;
    if (is_steady) motion.waits = 0;
    // Only free fall goes on. A predicted friction would reverse the motion of a body that stops.
    const bool falls = is_steady && (change / step - scene_.scene.gravity).norm() < kFalls;
    motion.acceleration = falls ? scene_.scene.gravity : Eigen::Vector3d(Eigen::Vector3d::Zero());
    motion.velocity = body.velocity;
  }
}

bool BodyStage::is_at(const OwnedEntity& entity, const haptics::BodyState& body) noexcept {
  const EntityTruth& truth = entity.truth();
  return truth.time > nanoseconds(0) && truth.position == body.position &&
         truth.orientation.coeffs() == truth_of(body, truth.time).orientation.coeffs();
}

void BodyStage::show(PeerView& view) const noexcept {
  if (own_ == nullptr) return;
  const haptics::BodyStates& states = own_->read();
  view.bodies = view.bodies_awake = 0;
  for (const haptics::BodyState& body : states.bodies) {
    view.bodies += body.is_owned() ? 1 : 0;
    view.bodies_awake += body.awake && body.is_owned() ? 1 : 0;
  }
  view.bodies_not_woken = states.crowded;
}

}  // namespace reckon::peer
