// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body that two fingers lift, shake and put down.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/squeezed_cube.hpp"

namespace reckon::haptics::lifted_body_test {
namespace {

using Eigen::Vector3d;
using squeezed::cube_of;
using squeezed::device_at;
using squeezed::ease;
using squeezed::hand_at;
using squeezed::kHalf;
using std::chrono::nanoseconds;

/// A cube on a floor, and fingers from both sides that lift it, shake it and put it down.
struct Lift {
  double highest = 0.0;  // [m], of the cube's middle
  double turned = 0.0;   // [rad], at most
  double slipped = 0.0;  // [m], of the cube relative to the fingers while carried
  double at_end = 0.0;   // [m], height
  double made = -1e9;    // [J]
};
/// @param off [m], offset of the fingers from the cube's middle  @param patch [m], of the fingers
Lift lift(double mass, double stiffness, double friction, double off = 0.0, double patch = 0.0) {
  Scene scene = cube_of(mass, stiffness);
  scene.gravity = {0, 0, -9.81};
  scene.objects[0].pose.position.z() = kHalf;
  scene.objects[0].effects.declare<StickSlipFriction>() = {friction, 0.9 * friction};
  SceneObject& floor = scene.objects.emplace_back();
  floor.name = "floor";
  floor.shape = PlaneShape{Vector3d::UnitZ()};
  floor.effects.of<SpringDamper>() = {400, 0.0};
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
  const auto script = [off](int side, double t) {
    HandTarget out = hand_at(side, std::min(t, 3.0));
    out.position.y() = off;
    out.velocity.setZero();
    const double way = side == 1 ? 1 : -1;
    if (t > 8.5) out.position.x() += way * 0.02 * ease((t - 8.5) / 0.5);
    const double shake =
        t > 4 && t < 7 ? 0.008 * std::sin(2 * std::numbers::pi * 3 * (t - 4)) : 0.0;
    out.position.z() = kHalf + 0.04 * (ease((t - 2) / 1.0) - ease((t - 7.2) / 1.0)) + shake;
    return out;
  };
  std::array<std::optional<SimulatedDevice>, 2> devices;
  std::array<std::optional<ServoLoop>, 2> servos;
  for (int s = 0; s < 2; ++s) {
    const auto k = static_cast<std::size_t>(s);
    devices[k].emplace(device_at(script(s, 0).position), [=](double t) { return script(s, t); });
    ServoConfig config;
    config.patch_radius = patch;
    servos[k].emplace(*devices[k], plan, config, world);
  }
  Lift out;
  std::optional<double> carried;
  for (int i = 0; i < 10'000; ++i) {
    double taken = 0.0;
    Vector3d fingers = Vector3d::Zero();
    for (std::size_t s = 0; s < 2; ++s) {
      servos[s]->step(nanoseconds(1'000'000'000 + 1'000'000L * i));
      taken += devices[s]->port_work() + devices[s]->damping_loss();
      EXPECT_TRUE(servos[s]->snapshots().update());
      fingers += 0.5 * servos[s]->snapshots().read().device;
    }
    const BodyState& cube = world->states()[0];
    out.made = std::max(out.made, world->energy() - taken);
    out.highest = std::max(out.highest, cube.position.z());
    if (i > 3000 && i < 7000) {
      const Eigen::AngleAxisd turn(cube.orientation);
      out.turned = std::max(out.turned, std::abs(turn.angle()));
      const double below = fingers.z() - cube.position.z();
      if (!carried) carried = below;
      out.slipped = std::max(out.slipped, std::abs(below - *carried));
    }
  }
  out.at_end = world->states()[0].position.z();
  return out;
}

TEST(PushedBody, IsLiftedShakenAndPutDown) {
  const Lift cube = lift(0.05, 400, 0.9);
  std::printf("turned %.3g rad, moved %.3g mm against the fingers, made %.3g J\n", cube.turned,
              1e3 * cube.slipped, cube.made);
  EXPECT_GT(cube.highest, kHalf + 0.03);
  EXPECT_LT(cube.turned, 0.02);
  EXPECT_LT(cube.slipped, 0.003) << "the springs of the fingers give way";
  EXPECT_NEAR(cube.at_end, kHalf, 1e-4);
  EXPECT_LE(cube.made, 1e-9);
  EXPECT_LT(lift(0.05, 400, 0.05).highest, kHalf + 0.005) << "a slippery one stays on the floor";
}

// Held beside its middle, a cube swings between two points. A patch holds it up to a torque of 2/3
// of friction, force and radius.
TEST(PushedBody, IsHeldAgainstTurningByPatches) {
  const Lift points = lift(0.1, 400, 0.9, 0.004);
  const Lift patches = lift(0.1, 400, 0.9, 0.004, 0.006);
  std::printf(
      "turned %.3g rad between points, %.3g between patches of 6 mm, made %.3g and %.3g J\n",
      points.turned, patches.turned, points.made, patches.made);
  EXPECT_GT(points.turned, 0.5);
  EXPECT_LT(patches.turned, 0.02);
  EXPECT_GT(patches.highest, kHalf + 0.03);
  EXPECT_LE(patches.made, 1e-9);
  EXPECT_GT(lift(0.1, 400, 0.9, 0.004, 0.001).turned, 0.3) << "too small a patch slips";
}

}  // namespace
}  // namespace reckon::haptics::lifted_body_test
