// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/woken_bodies.hpp"

#include <algorithm>
#include <utility>

#include "reckon/haptics/bodies/body_solver.hpp"

namespace reckon::haptics {
namespace {

constexpr std::size_t kMostLeft = 256;  // bodies between two updates of a copy of the states

}  // namespace

WokenBodies::WokenBodies(BodySlots& slots) : slots_(slots) {
  in_slot_.fill(kNobody);
  for (std::size_t slot = 0; slot < slots.size(); ++slot)
    in_slot_[slot] = static_cast<std::uint32_t>(slots[slot].number);
  met_.reserve(BodySlots::kMost);
  left_.reserve(kMostLeft);
}

WokenBodies::Taken WokenBodies::take_in(std::size_t body, BodySet pinned) noexcept {
  Taken out;
  out.slot = slots_.take_in(body, pinned);
  if (out.slot == BodySlots::kNone) {
    if (!std::exchange(is_crowded_, true)) ++crowded_;
    return out;
  }
  out.lost = std::exchange(in_slot_[out.slot], static_cast<std::uint32_t>(body));
  if (out.lost != kNobody) note_changed(out.lost);
  return out;
}

void WokenBodies::note_changed(std::uint32_t body) noexcept {
  if (left_.size() == kMostLeft) left_.erase(left_.begin());
  left_.push_back(body);
  ++left_count_;
}

// Box of a body and its way.
Eigen::AlignedBox3d WokenBodies::reach_of(std::size_t slot, double time) const noexcept {
  const double way = BodySolver::kNear + time * slots_[slot].motion().velocity.norm();
  Eigen::AlignedBox3d box = box_of(slots_[slot].geom);
  const Eigen::Vector3d low = box.min().array() - way, high = box.max().array() + way;
  return box.extend(low).extend(high);
}

std::span<const std::uint32_t> WokenBodies::met(double time) noexcept {
  slots_.each(slots_.carried(), [&](std::size_t slot) { slots_[slot].island = slot; });
  met_.clear();
  if (slots_.asleep().size() == 0) return met_;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    if (!slots_[slot].is_awake() || slots_[slot].geom == nullptr) continue;
    slots_.visit_asleep(slot, reach_of(slot, time), [&](std::uint32_t body) {
      if (met_.size() < met_.capacity()) met_.push_back(body);
    });
  }
  std::ranges::sort(met_);  // the result does not depend on the order of the grid
  return met_;
}

std::span<const std::uint32_t> WokenBodies::touching(const Eigen::AlignedBox3d& box) noexcept {
  met_.clear();
  slots_.asleep().visit(box, [&](std::uint32_t body) {
    if (met_.size() < met_.capacity()) met_.push_back(body);
  });
  std::ranges::sort(met_);
  return met_;
}

std::uint32_t WokenBodies::island_of(std::size_t slot) const noexcept {
  const std::size_t touched = slots_[slot].island;
  const std::size_t root = slots_[touched].is_awake() ? slots_[touched].island : slot;
  return in_slot_[root];
}

void WokenBodies::wake(const Eigen::AlignedBox3d& box) noexcept {
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    RigidBody& body = slots_[slot];
    if (body.is_carried || body.is_awake() || !box.intersects(box_of(body.geom))) continue;
    body.wake();
  }
}

bool WokenBodies::is_any_moving(double time) const noexcept {
  BodySet owned = 0, moved = 0;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    const bool is_awake = slots_[slot].is_awake();
    if (!slots_[slot].is_carried && is_awake) return true;
    const BodySet one = BodySet{1} << slot;
    owned |= slots_[slot].is_carried ? 0 : one;
    moved |= slots_[slot].is_carried && is_awake && slots_[slot].geom != nullptr ? one : 0;
  }
  bool found = false;
  slots_.each(moved, [&](std::size_t slot) {
    const Eigen::AlignedBox3d reach = reach_of(slot, time);
    slots_.each(owned, [&](std::size_t other) {
      found = found || reach.intersects(box_of(slots_[other].geom));
    });
    slots_.asleep().visit(
        reach, [&](std::uint32_t other) { found = found || !slots_.kinds()[other].is_carried; });
  });
  return found;
}

}  // namespace reckon::haptics
