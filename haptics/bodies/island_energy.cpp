// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/island_energy.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reckon::haptics {

void IslandEnergy::begin(const BodySlots& slots, BodySet acting,
                         const Eigen::Vector3d& gravity) noexcept {
  acting_ = acting & ~slots.carried();
  gravity_ = gravity;
  slots.each(acting_, [&](std::size_t i) {
    of_[i] = {};
    of_[i].height = slots[i].weight_energy(gravity);
    of_[i].motion = slots[i].kinetic_energy();
  });
}

void IslandEnergy::sink(std::size_t slot, double depth) noexcept {
  of_[slot].depth = std::max(of_[slot].depth, depth);
}

void IslandEnergy::drive(std::size_t slot, double speed) noexcept {
  of_[slot].driven = std::max(of_[slot].driven, speed);
}

double IslandEnergy::settle(BodySlots& slots, Islands& islands) noexcept {
  std::array<Island, BodySlots::kMost> all;
  BodySet roots = 0;
  slots.each(acting_, [&](std::size_t i) {
    const std::size_t root = islands.island_of(i);
    if ((roots >> root & 1) == 0) all[root] = {};
    roots |= BodySet{1} << root;
    all[root].bodies |= BodySet{1} << i;
    add(all[root], slots[i], of_[i]);
  });
  double taken = 0.0;
  for (; roots != 0; roots &= roots - 1) {
    Island& island = all[static_cast<std::size_t>(std::countr_zero(roots))];
    taken += take_out(island, slots);
    share(island, slots, of_);
  }
  return taken;
}

void IslandEnergy::add(Island& island, const RigidBody& body, const Sum& sum) const noexcept {
  island.of.height += sum.height;
  island.of.motion += sum.motion;
  island.of.given += sum.given;
  island.of.depth += sum.depth;
  island.of.pressed += sum.pressed;
  island.of.driven = std::max(island.of.driven, sum.driven);
  island.of.is_pinned |= sum.is_pinned;
  island.account += body.account;
  island.height += body.weight_energy(gravity_);
  island.motion += body.kinetic_energy();
  island.mass += body.mass;
  island.sunk += body.mass * sum.depth;
}

double IslandEnergy::take_out(Island& island, BodySlots& slots) const noexcept {
  const Sum& was = island.of;
  const double before = was.height + was.motion;
  double left = island.account + was.given - (island.height + island.motion - before);
  double taken = left < 0 ? std::min(-left, island.motion) : 0.0;
  if (was.driven > 0 && was.is_pinned) {
    const double fallen = std::max(0.0, was.height - island.height);
    const double most = std::max(was.motion + fallen, 0.5 * island.mass * was.driven * was.driven);
    taken = std::max(taken, island.motion - most);
  }
  if (taken > 0) {
    const double slower = taken < island.motion ? std::sqrt(1.0 - taken / island.motion) : 0.0;
    slots.each(island.bodies, [&](std::size_t i) { slots[i].slow(slower); });
    left += taken;
  }
  // A stack of bodies is lifted at most by the sum of its depths.
  const double lift = was.depth * (gravity_.norm() * island.mass + was.pressed);
  island.account = std::min(left, lift);
  return std::max(0.0, taken);
}

void IslandEnergy::share(const Island& island, BodySlots& slots,
                         const std::array<Sum, BodySlots::kMost>& of) noexcept {
  slots.each(island.bodies, [&](std::size_t i) {
    const double part =
        island.sunk > 0 ? slots[i].mass * of[i].depth / island.sunk : slots[i].mass / island.mass;
    slots[i].account = part * island.account;
  });
}

}  // namespace reckon::haptics
