// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/carried_objects.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace reckon::haptics {
namespace {

constexpr double kJump = 0.002;     // [m], shorter ways are the corrections of a predicted pose
constexpr double kExplained = 2.0;  // times the way at the mover's velocity

}  // namespace

CarriedObjects::CarriedObjects(const EffectPlan& plan, const BodySlots& slots,
                               std::shared_ptr<ObjectMover> mover)
    : mover_(std::move(mover)) {
  carried_.reserve(slots.kinds().size());
  for (const BodyKind& kind : slots.kinds()) {
    Carried& one = all_.emplace_back();
    one.object = kind.object;
    const PlannedObject& object = plan.objects()[kind.object];
    one.origin = object.origin;
    one.now = {object.position, Eigen::Quaterniond(object.orientation)};
    one.may_jump = kind.can_be_owned;
    if (kind.is_carried) carried_.push_back(static_cast<std::uint32_t>(kind.number));
  }
  if (!carried_.empty() && mover_ == nullptr)
    throw std::invalid_argument("objects below moving nodes need a mover");
}

void CarriedObjects::add(std::uint32_t body, const ObjectMotion& at) noexcept {
  follow(body, at);
  Carried& one = all_[body];
  if (mover_ == nullptr) return;
  ObjectMotion object = one.now;
  object.position -= at.orientation * one.origin;
  mover_->leave_at(one.object, object);
}

void CarriedObjects::follow(std::uint32_t body, const ObjectMotion& at) noexcept {
  Carried& one = all_[body];
  one.before = one.now = {at.position, at.orientation};
  carried_.insert(std::ranges::lower_bound(carried_, body), body);
}

ObjectMotion CarriedObjects::motion_of(std::uint32_t body, std::chrono::nanoseconds now) noexcept {
  const Carried& one = all_[body];
  if (mover_ == nullptr) return one.now;
  ObjectMotion motion = mover_->motion_of(one.object, now);
  const Eigen::Vector3d arm = motion.orientation * one.origin;
  motion.position += arm;
  motion.velocity += motion.turn_rate.cross(arm);
  return motion;
}

void CarriedObjects::see(std::chrono::nanoseconds now, double gap) noexcept {
  for (const std::uint32_t body : carried_) {
    Carried& one = all_[body];
    one.before = one.now;
    if (mover_ == nullptr) continue;
    one.now = motion_of(body, now);
    if (!one.may_jump) continue;
    const double speed = std::max(one.before.velocity.norm(), one.now.velocity.norm());
    one.jumps = (one.now.position - one.before.position).norm() > kJump + kExplained * speed * gap;
  }
}

bool CarriedObjects::is_moved(std::uint32_t body) const noexcept {
  const Carried& one = all_[body];
  return one.now.position != one.before.position ||
         one.now.orientation.coeffs() != one.before.orientation.coeffs();
}

void CarriedObjects::drive(BodySlots& slots, double gap) const noexcept {
  for (const std::uint32_t body : carried_) {
    const std::size_t slot = slots.slot_of(body);
    if (slot == BodySlots::kNone) continue;
    const Carried& one = all_[body];
    ObjectMotion way = one.now;
    if (one.may_jump) {
      // The correction of a prediction has no impulse, or bodies of two peers drive each other.
      way.position -= gap * way.velocity;
    } else {
      way = one.before;
      way.velocity = (one.now.position - one.before.position) / gap;
      const Eigen::AngleAxisd turn(one.now.orientation * one.before.orientation.conjugate());
      way.turn_rate = turn.angle() / gap * turn.axis();
    }
    slots[slot].carry(one.jumps ? one.now : way);
  }
}

void CarriedObjects::put(BodySlots& slots) const noexcept {
  for (const std::uint32_t body : carried_) {
    const std::size_t slot = slots.slot_of(body);
    if (slot != BodySlots::kNone) slots[slot].carry(all_[body].now);
  }
}

}  // namespace reckon::haptics
