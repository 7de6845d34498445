// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/moving_objects.hpp"

#include <algorithm>

#include "reckon/haptics/queries/pair_query.hpp"

namespace reckon::haptics {

using Eigen::Vector3d;

bool jumps(const ObjectMotion& now, const ObjectMotion& before) noexcept {
  constexpr double kWay = 0.03, kTurn = 0.5, kMotion = 0.01;  // [m], [rad], [s]
  const double speed = std::max(now.velocity.norm(), before.velocity.norm());
  if ((now.position - before.position).norm() > kWay + kMotion * speed) return true;
  const double rate = std::max(now.turn_rate.norm(), before.turn_rate.norm());
  return now.orientation.angularDistance(before.orientation) > kTurn + kMotion * rate;
}

bool MovingObject::is_outside(const Vector3d& p_S) const noexcept {
  static const QueryShape point = QueryShape::sphere(0.0);
  return measure_pair(point, {p_S}, solid, {now.position, now.orientation}).distance.least > 0.0;
}

MovingObjects::MovingObjects(const EffectPlan& plan) {
  moving_.reserve(
      static_cast<std::size_t>(std::ranges::count_if(plan.objects(), &PlannedObject::moves)));
  placed_.reserve(moving_.capacity());
  of_.assign(plan.objects().size(), kNobody);
  for (std::uint32_t i = 0; i < of_.size(); ++i) {
    const PlannedObject& object = plan.objects()[i];
    if (!object.moves()) continue;
    of_[i] = static_cast<std::uint32_t>(moving_.size());
    const ObjectMotion start{object.position, Eigen::Quaterniond(object.orientation)};
    moving_.push_back({i, object, start, start, 0, Vector3d::Zero(), QueryShape(object.shape)});
  }
}

void MovingObjects::place(std::uint32_t body, const ObjectMotion& motion,
                          const ObjectMotion& before,
                          std::span<const ObjectContact> contacts) noexcept {
  MovingObject& moving = moving_[body];
  if (moving.placed == round_) return;
  forget_placed(round_);
  placed_.push_back(body);
  const bool was_met = moving.placed + 1 == round_;
  moving.placed = round_;
  moving.pushed = contacts[moving.object].force;
  moving.before = was_met ? moving.motion : before;
  moving.motion = motion;
  // It has not moved.
  if (was_met && !moving.is_moved()) return;
  if (!moving.pushed.isZero(0.0) && jumps(motion, moving.before)) {
    moving.before = motion;
    moving.pushed.setZero();
  }
  moving.now.place(motion.position, motion.orientation.toRotationMatrix());
}

// Forgets the objects of earlier rounds.
void MovingObjects::forget_placed(std::uint64_t round) noexcept {
  if (!placed_.empty() && moving_[placed_.front()].placed != round) placed_.clear();
}

Vector3d MovingObjects::velocity_of(std::uint32_t index, const Vector3d& point) const noexcept {
  const MovingObject* moving = moving_as(index);
  return moving != nullptr ? moving->motion.velocity_at(point) : Vector3d::Zero();
}

// Exact for springs held before and after. A surface in new contact stores no more than its energy
// then, and gives nothing at the end of the contact.
double MovingObjects::carried_work(std::span<const ObjectContact> contacts) const noexcept {
  double sum = 0.0;
  for (const std::uint32_t body : placed_) {
    const MovingObject& moving = moving_[body];
    if (!moving.now.carried) continue;
    const ObjectContact& contact = contacts[moving.object];
    const bool was = !moving.pushed.isZero(0.0);
    if (!was && !contact.in_contact) continue;
    const Vector3d way = contact.scp - moving.before.position -
                         moving.before.orientation * (moving.motion.orientation.conjugate() *
                                                      (contact.scp - moving.motion.position));
    const double work = 0.5 * (moving.pushed + contact.force).dot(way);
    if (was && contact.in_contact) {
      sum += work;
    } else {
      const double least = jumps(moving.motion, moving.before) ? 0.0 : work;
      sum += std::min(std::max(work, least), contact.in_contact ? contact.stored_energy : 0.0);
    }
  }
  return sum;
}

double MovingObjects::ahead_of(std::uint32_t index) const noexcept {
  const MovingObject* moving = moving_as(index);
  return moving != nullptr ? 0.5 * moving->motion.step : 0.0;
}

std::optional<NearBody> MovingObjects::near_body(
    std::size_t& next, const MovingProbe& probe,
    std::span<const ObjectContact> contacts) const noexcept {
  while (next < placed_.size()) {
    const MovingObject& moving = moving_[placed_[next++]];
    if (contacts[moving.object].in_contact) continue;
    const PlannedObject& object = moving.now;
    const Vector3d at = object.to_object(probe.place);
    const double speed = (probe.velocity - moving.motion.velocity).norm() +
                         moving.motion.turn_rate.norm() * (probe.place - object.position).norm();
    const double reach = speed * probe.time + probe.radius;
    if (distance_below(object.shape, at) > reach) continue;
    const std::optional<Vector3d> nearest = nearest_inside(object.shape, at);
    if (!nearest) continue;
    const double distance = (at - *nearest).norm();
    if (!(distance > probe.radius) || distance > reach) continue;
    return NearBody{moving.object, object.to_scene(*nearest),
                    object.orientation * ((at - *nearest) / distance), distance - probe.radius};
  }
  return std::nullopt;
}

}  // namespace reckon::haptics
