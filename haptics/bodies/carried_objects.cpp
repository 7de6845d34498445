// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/carried_objects.hpp"

#include <stdexcept>
#include <utility>

namespace reckon::haptics {

CarriedObjects::CarriedObjects(const EffectPlan& plan, const BodySolver& solver,
                               std::shared_ptr<ObjectMover> mover)
    : mover_(std::move(mover)) {
  const std::vector<BodyKind>& kinds = solver.slots().kinds();
  for (std::size_t slot = 0; slot < solver.size(); ++slot) {
    const std::uint32_t object = kinds[solver.body(slot)].object;
    if (solver.is_carried(slot)) carried_.push_back({slot, object, plan.objects()[object].origin});
  }
  if (!carried_.empty() && mover_ == nullptr)
    throw std::invalid_argument("objects below moving nodes need a mover");
}

void CarriedObjects::see(std::chrono::nanoseconds now) noexcept {
  for (Carried& one : carried_) {
    one.before = one.now;
    one.now = mover_->motion_of(one.object, now);
    const Eigen::Vector3d arm = one.now.orientation * one.origin;
    one.now.position += arm;
    one.now.velocity += one.now.turn_rate.cross(arm);
  }
}

void CarriedObjects::drive(BodySolver& solver, double gap) const noexcept {
  for (const Carried& one : carried_) {
    ObjectMotion way = one.before;
    way.velocity = (one.now.position - one.before.position) / gap;
    const Eigen::AngleAxisd turn(one.now.orientation * one.before.orientation.conjugate());
    way.turn_rate = turn.angle() / gap * turn.axis();
    solver.carry(one.slot, way);
  }
}

void CarriedObjects::put(BodySolver& solver) const noexcept {
  for (const Carried& one : carried_) solver.carry(one.slot, one.now);
}

}  // namespace reckon::haptics
