// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/hand_port.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

// Body axes of a hand in the scene: forward = east, right = south, down = -up.
// Three-degree-of-freedom devices do not turn, so this never changes.
const Eigen::Quaterniond kHandOrientation(0.0, 1.0, 0.0, 0.0);

// Time constant [s] of the velocity that is sent while hands touch. Below it two hands of 0.1 kg
// over 500 N/m ring at 16 Hz, above it they lag behind a common motion; docs/haptic_stability.md
// has the table.
constexpr double kContactSmoothing = 0.05;
bool touches(const haptics::ServoSnapshot& snapshot) {
  return std::any_of(snapshot.contacts.begin(),
                     snapshot.contacts.begin() + static_cast<std::ptrdiff_t>(snapshot.count),
                     [](const auto& contact) { return contact.ungated_force.squaredNorm() > 0.0; });
}

}  // namespace

pdu::EntityType hand_type() noexcept {
  pdu::EntityType type{};
  type.kind = pdu::EntityKind::life_form;
  type.domain = pdu::EntityDomain::land;
  return type;
}

void HandPort::tell(OwnedEntity& entity) noexcept {
  const haptics::ServoSnapshot& snapshot = servo();
  const bool touching = touches(snapshot);
  if (touching != touching_) {
    entity.felt_event();
    contact_velocity_.setZero();
  }
  touching_ = touching;
  smooth_velocity();
  read_accounts();

  EntityTruth truth;
  truth.time = snapshot.time;
  truth.position = snapshot.scp;
  truth.orientation = kHandOrientation;
  truth.velocity = snapshot.velocity;
  truth.acceleration = snapshot.acceleration;
  if (touching_) truth.lasting_velocity = contact_velocity_;
  entity.move(truth);
  if (TouchSide* touch = entity.touch(); touch != nullptr && !entity.is_frozen()) {
    touch->move_point(kHandOrientation.conjugate() * (snapshot.device - snapshot.scp));
    touch->soften(snapshot.softening);
  }
  entity.consider_accounts(snapshot.time, accounts());
  if (touching_ && snapshot.time - entity.last_built() >= kContactPeriod) entity.felt_event();
}

void HandPort::note_near(OwnedEntity& entity) const noexcept {
  if (servo().time - entity.last_built() >= kContactPeriod) entity.felt_event();
}

// While hands touch, the quick part of the motion of each is the other's doing: extrapolated, it
// would come back through the contact too late for a spring's force, and the pair would ring until
// its ledgers are empty. The slow part, which both make together, is what a prediction is for; of
// the motion that made them meet nothing is left, so it begins at rest.
void HandPort::smooth_velocity() noexcept {
  const haptics::ServoSnapshot& snapshot = servo();
  const double dt = std::clamp(pdu::to_seconds(snapshot.time - last_seen_), 0.0, kContactSmoothing);
  last_seen_ = snapshot.time;
  const double share = touching_ ? dt / (kContactSmoothing + dt) : 1.0;
  contact_velocity_ += share * (snapshot.velocity - contact_velocity_);
}

void HandPort::read_accounts() noexcept {
  const haptics::ServoSnapshot& snapshot = servo();
  account_count_ = std::min(snapshot.count, accounts_.size());
  for (std::size_t i = 0; i < account_count_; ++i) {
    const haptics::ContactAccount& contact = snapshot.contacts[i];
    accounts_[i] = {contact.id, contact.given, contact.need, contact.spring_need};
  }
}

}  // namespace reckon::peer
