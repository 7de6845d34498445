// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/body_sleep.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

constexpr double kStillSpeed = 1e-3;  // [m/s]
constexpr double kStillTurn = 0.02;   // [rad/s]

}  // namespace

void put_to_sleep(BodySlots& slots, BodySet acting, ContactJoints& joints, double dt) noexcept {
  IslandEnergy::Islands& islands = joints.islands();
  std::array<double, BodySlots::kMost> still;  // [s], of islands
  still.fill(std::numeric_limits<double>::infinity());
  slots.each(acting, [&](std::size_t i) {
    RigidBody& body = slots[i];
    if (!(body.mass > 0)) return;
    body.island = i;
    if (!body.is_awake()) return;
    body.island = islands.island_of(i);
    const double speed = vector_of(dBodyGetLinearVel(body.id)).norm();
    if (speed > BodyWorld::kFastest) body.slow(BodyWorld::kFastest / speed);
    const bool is =
        speed < kStillSpeed && vector_of(dBodyGetAngularVel(body.id)).norm() < kStillTurn;
    body.still = is ? body.still + dt : 0.0;
    double& least = still[body.island];
    least = std::min(least, body.still);
  });
  for (const auto& [slot, carried] : joints.met_carried()) slots[carried].island = slot;
  slots.each(acting, [&](std::size_t i) {
    RigidBody& body = slots[i];
    if (!(body.mass > 0) || !body.is_awake()) return;
    if (still[body.island] < pdu::to_seconds(BodyWorld::kSleep)) return;
    body.slow(0.0);
    dBodyDisable(body.id);
  });
}

}  // namespace reckon::haptics
