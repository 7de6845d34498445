// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/ordered_bodies.hpp"

#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kFarthestPlace = 1e6;  // [m], beyond which a body is lost
constexpr double kMostImpulse = 1e6;    // [N s]
constexpr double kUnit = 1e-3;          // error of the norm of a unit quaternion

bool is_within(const Eigen::Vector3d& v, double most) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= most;
}

bool is_usable(const ObjectMotion& state) {
  return is_within(state.position, kFarthestPlace) && is_within(state.velocity, kFarthestPlace) &&
         is_within(state.turn_rate, kFarthestPlace) &&
         std::abs(state.orientation.norm() - 1.0) <= kUnit;
}

ObjectMotion normalized(ObjectMotion state) {
  state.orientation.normalize();
  return state;
}

}  // namespace

bool OrderedBodies::admits(const BodyOrder& order) const noexcept {
  if (order.body >= slots_.kinds().size()) return false;
  const BodyKind& kind = slots_.kinds()[order.body];
  const bool is_copied = copied_.contains(order.body);
  const bool is_owned = !kind.is_carried && !is_copied;
  switch (order.act) {
    case BodyAct::own:
    case BodyAct::adopt:
      return kind.can_be_owned && is_usable(order.state);
    case BodyAct::copy:
      return kind.can_be_owned && !is_owned && is_usable(order.state);
    case BodyAct::follow:
      return is_copied;
    case BodyAct::place:
      return is_owned && is_usable(order.state);
    case BodyAct::push:
      return is_owned && is_within(order.impulse, kMostImpulse) &&
             is_within(order.point, kFarthestPlace);
    case BodyAct::disown:
    case BodyAct::wake:
      break;
  }
  return is_owned;
}

void OrderedBodies::carry_out(const BodyOrder& order, std::size_t slot) noexcept {
  const bool has_slot = slot != BodySlots::kNone;
  const bool is_copied = copied_.contains(order.body);
  if (order.act == BodyAct::disown || order.act == BodyAct::follow) {
    const ObjectMotion at = slots_.motion_of(order.body);
    slots_.set_carried(order.body, true);
    copied_.remove(order.body);
    is_copied ? carried_.follow(order.body, at) : carried_.add(order.body, at);
    if (has_slot) slots_[slot].carry(carried_.now(order.body));
  } else if (order.act == BodyAct::wake) {
    if (has_slot) slots_[slot].wake();
  } else if (order.act == BodyAct::push) {
    if (has_slot) slots_[slot].strike(order.impulse, order.point);
  } else if (order.act == BodyAct::own && is_copied) {
    copied_.remove(order.body);
    // A hand of this peer may have moved the copy far away while no state of the owner arrived.
    if (has_slot && !CopiedBodies::is_near(slots_.motion_of(order.body), order.state))
      slots_[slot].start(normalized(order.state));
  } else if (order.act == BodyAct::adopt && is_copied && !copied_.is_drawn(order.body)) {
    copied_.remove(order.body);
  } else if (order.act == BodyAct::adopt && is_copied) {
    // Keeps the pose, so that no force jumps. The draw never corrects the copy's velocity.
    copied_.remove(order.body);
    ObjectMotion state = slots_.motion_of(order.body);
    state.velocity = order.state.velocity;
    state.turn_rate = order.state.turn_rate;
    if (has_slot) slots_[slot].start(state);
  } else if (order.act == BodyAct::copy && is_copied) {
    copied_.add(order.body, order.delay);
  } else if (order.act != BodyAct::copy || has_slot) {
    slots_.set_carried(order.body, false);
    carried_.remove(order.body);
    if (order.act == BodyAct::copy) copied_.add(order.body, order.delay);
    const ObjectMotion state = normalized(order.state);
    has_slot ? slots_[slot].start(state) : slots_.lie(order.body, state);
  }
}

}  // namespace reckon::haptics
