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

}  // namespace

bool OrderedBodies::admits(const BodyOrder& order) const noexcept {
  if (order.body >= slots_.kinds().size()) return false;
  const BodyKind& kind = slots_.kinds()[order.body];
  switch (order.act) {
    case BodyAct::own:
      return kind.can_be_owned && is_usable(order.state);
    case BodyAct::place:
      return !kind.is_carried && is_usable(order.state);
    case BodyAct::push:
      return !kind.is_carried && is_within(order.impulse, kMostImpulse) &&
             is_within(order.point, kFarthestPlace);
    case BodyAct::disown:
    case BodyAct::wake:
      break;
  }
  return !kind.is_carried;
}

void OrderedBodies::carry_out(const BodyOrder& order, std::size_t slot) noexcept {
  const bool has_slot = slot != BodySlots::kNone;
  if (order.act == BodyAct::disown) {
    const ObjectMotion at = slots_.motion_of(order.body);
    slots_.set_carried(order.body, true);
    carried_.add(order.body, at);
    if (has_slot) slots_[slot].carry(carried_.now(order.body));
  } else if (order.act == BodyAct::wake) {
    if (has_slot) slots_[slot].wake();
  } else if (order.act == BodyAct::push) {
    if (has_slot) slots_[slot].strike(order.impulse, order.point);
  } else {
    slots_.set_carried(order.body, false);
    carried_.remove(order.body);
    ObjectMotion state = order.state;
    state.orientation.normalize();
    has_slot ? slots_[slot].start(state) : slots_.lie(order.body, state);
  }
}

}  // namespace reckon::haptics
