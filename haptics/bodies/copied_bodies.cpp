// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/copied_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

CopiedBodies::CopiedBodies(BodySlots& slots, CarriedObjects& carried)
    : slots_(slots), carried_(carried) {
  copies_.reserve(slots.kinds().size());
}

bool CopiedBodies::contains(std::uint32_t body) const noexcept {
  return std::ranges::find(copies_, body, &Copy::body) != copies_.end();
}

bool CopiedBodies::is_drawn(std::uint32_t body) const noexcept {
  const auto known = std::ranges::find(copies_, body, &Copy::body);
  return known != copies_.end() && !std::isinf(known->time);
}

void CopiedBodies::add(std::uint32_t body, double delay) noexcept {
  const double time = kLeast + kDelays * std::max(0.0, delay);
  const auto known = std::ranges::find(copies_, body, &Copy::body);
  if (known != copies_.end()) {
    known->time = time;
  } else {
    copies_.push_back({body, time});
  }
}

void CopiedBodies::remove(std::uint32_t body) noexcept {
  std::erase_if(copies_, [body](const Copy& copy) { return copy.body == body; });
}

void CopiedBodies::draw(std::chrono::nanoseconds now, double gap) noexcept {
  for (Copy& copy : copies_) {
    copy.way.setZero();
    copy.turn.setZero();
    const std::size_t slot = slots_.slot_of(copy.body);
    if (slot == BodySlots::kNone || !is_drawn(copy.body)) continue;
    const ObjectMotion there = carried_.motion_of(copy.body, now);
    RigidBody& body = slots_[slot];
    const ObjectMotion here = body.motion();
    const bool is_lost = !((there.position - here.position).norm() <= kFarthest);
    const double share = is_lost ? 1.0 : std::min(1.0, gap / copy.time);
    const Eigen::Quaterniond turned = here.orientation.slerp(share, there.orientation);
    const Eigen::AngleAxisd turn(turned * here.orientation.conjugate());
    copy.way = share * (there.position - here.position);
    copy.turn = turn.angle() * turn.axis();
    is_lost ? body.start(there) : body.shift(copy.way, turned);
  }
}

}  // namespace reckon::haptics
