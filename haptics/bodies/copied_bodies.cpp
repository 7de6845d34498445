// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/copied_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kDeviation = 0.001;  // [m], from the mean offset, without a correction

struct IslandOffset {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // [m], of the ways of its copies
  double copies = 0.0;
};

}  // namespace

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

// Stated poses of two touching bodies may overlap by their errors. Separate corrections would press
// the copies into each other, against their hands.
void CopiedBodies::draw(std::chrono::nanoseconds now, double gap) noexcept {
  std::array<IslandOffset, BodySlots::kMost> islands{};
  for (Copy& copy : copies_) {
    copy.way.setZero();
    copy.turn.setZero();
    const std::size_t slot = slots_.slot_of(copy.body);
    if (slot == BodySlots::kNone || !is_drawn(copy.body)) continue;
    copy.way = carried_.motion_of(copy.body, now).position - slots_[slot].motion().position;
    IslandOffset& island = islands[slots_[slot].island];
    if (!(copy.way.norm() <= kFarthest)) continue;
    island.sum += copy.way;
    island.copies += 1.0;
  }
  for (Copy& copy : copies_) {
    const std::size_t slot = slots_.slot_of(copy.body);
    if (slot == BodySlots::kNone || !is_drawn(copy.body)) continue;
    const ObjectMotion there = carried_.motion_of(copy.body, now);
    RigidBody& body = slots_[slot];
    const IslandOffset& island = islands[body.island];
    const ObjectMotion here = body.motion();
    const bool is_lost = !is_near(here, there);
    const double share = is_lost ? 1.0 : std::min(1.0, gap / copy.time);
    if (!is_lost && island.copies > 1.0) {
      const Eigen::Vector3d mean = island.sum / island.copies, deviation = copy.way - mean;
      copy.way = mean + deviation * std::max(0.0, 1.0 - kDeviation /
                                                            std::max(kDeviation, deviation.norm()));
    }
    copy.way *= share;
    const Eigen::Quaterniond turned = here.orientation.slerp(share, there.orientation);
    const Eigen::AngleAxisd turn(turned * here.orientation.conjugate());
    copy.turn = turn.angle() * turn.axis();
    is_lost ? body.start(there) : body.shift(copy.way, turned);
  }
}

}  // namespace reckon::haptics
