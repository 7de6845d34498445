// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that change their owner while a hand touches or holds them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/held_cube.hpp"
#include "reckon/tests/haptics/support/moved_bodies.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::handed_over_body_test {
namespace {

using Eigen::Vector3d;
using grabbed::kHalf;
using grabbed::kT;
using std::chrono::nanoseconds;
using tables::MovedBodies;

Scene cube_on_floor() {
  Scene scene = grabbed::cube_of(0.05, {0, 0, -9.81});
  scene.objects[0].pose.position.z() = kHalf;
  scene.objects[0].matter.friction = 0.5;
  SceneObject& floor = scene.objects.emplace_back();
  floor.name = "floor";
  floor.shape = PlaneShape{};
  floor.matter.friction = 0.5;
  return scene;
}

/// One hand, and a cube on a floor.
struct Rig {
  explicit Rig(HandScript script)
      : scene(cube_on_floor()),
        plan(std::make_shared<const EffectPlan>(scene)),
        mover(std::make_shared<MovedBodies>()),
        world(std::make_shared<BodyWorld>(*plan, scene.gravity, mover)),
        device(grabbed::device_at(script(0).position), script),
        servo(device, plan, grabbed::holding(150, 0.5), world) {}

  const ServoSnapshot& step() {
    servo.step(now);
    now += nanoseconds(1'000'000);
    EXPECT_TRUE(servo.snapshots().update());
    return servo.snapshots().read();
  }
  const BodyState& cube() const { return world->states()[0]; }

  Scene scene;
  std::shared_ptr<const EffectPlan> plan;
  std::shared_ptr<MovedBodies> mover;
  std::shared_ptr<BodyWorld> world;
  SimulatedDevice device;
  ServoLoop servo;
  nanoseconds now{1'000'000'000};
};

// Down onto the cube, and up with it.
HandTarget lifts(double t) {
  HandTarget out;
  const double down = std::min(t, 0.5) / 0.5, up = std::clamp((t - 1.0) / 1.0, 0.0, 1.0);
  out.position.z() = 0.05 - 0.02 * down + 0.1 * up * up * (3 - 2 * up);
  out.buttons = t > 0.8 ? 1 : 0;
  return out;
}

// Back and forth through where the cube is.
HandTarget shoves(double t) {
  return {{-0.06 + 0.06 * (1 - std::cos(3.0 * t)), 0.002 * std::sin(11 * t), kHalf}};
}

TEST(HandedOverBody, IsReleasedByTheHand) {
  Rig rig(lifts);
  for (int i = 0; i < 2'000; ++i) ASSERT_GE(rig.step().port_energy_min, -1e-9);
  ASSERT_EQ(rig.step().held.number, 1);
  const double height = rig.cube().position.z();
  ASSERT_GT(height, 0.05);
  rig.world->disown(0);
  EXPECT_EQ(rig.step().held.number, 0);
  for (int i = 0; i < 500; ++i) ASSERT_GE(rig.step().port_energy_min, -1e-9);
  EXPECT_EQ(rig.step().held.number, 0) << "a hand holds only bodies that its peer simulates";
  EXPECT_NEAR(rig.cube().position.z(), height, 1e-3);
  rig.world->own(0, rig.cube());
  for (int i = 0; i < 100; ++i) ASSERT_GE(rig.step().port_energy_min, -1e-9);
  EXPECT_TRUE(rig.world->states()[0].awake);
}

TEST(HandedOverBody, IsPushedOnlyWhileOwned) {
  Rig rig(shoves);
  rig.world->disown(0);
  double felt = 0.0;
  for (int i = 0; i < 1'000; ++i) felt = std::max(felt, rig.step().force.norm());
  EXPECT_GT(felt, 0.5);
  EXPECT_EQ(rig.cube().position.x(), 0.0);
  rig.world->own(0, rig.cube());
  const double at_others = rig.step().tally.bodies;
  for (int i = 0; i < 2'000; ++i) rig.step();
  EXPECT_GT(rig.cube().position.x(), 0.02);
  EXPECT_EQ(rig.step().tally.bodies, at_others);
}

TEST(HandedOverBody, IsNotPushedWhereItIsPut) {
  Rig rig(shoves);
  while (rig.step().force.norm() < 0.3) ASSERT_LT(rig.now, std::chrono::seconds(5));
  rig.world->order({BodyAct::place, 0, {{1, 0, kHalf}, Eigen::Quaterniond::Identity()}});
  rig.step();
  EXPECT_LT(rig.cube().velocity.head<2>().norm(), 1e-6);
}

// The owner moves it; the hand touches it or a copy.
TEST(HandedOverBody, LeavesTheHandWhenPutElsewhere) {
  for (const bool copied : {false, true}) {
    SCOPED_TRACE(copied);
    Rig rig(shoves);
    rig.world->disown(0);
    rig.step();
    if (copied) rig.world->order({BodyAct::copy, 0, rig.cube()});
    while (rig.step().force.norm() < 0.3) ASSERT_LT(rig.now, std::chrono::seconds(5));
    ASSERT_EQ(rig.cube().copied, copied);
    rig.mover->of(0).position.x() += 0.2;
    for (int i = 0; i < 20; ++i) rig.step();
    EXPECT_LT(rig.step().force.norm(), 0.01);
    EXPECT_LT(rig.cube().velocity.head<2>().norm(), 0.01) << "nobody pushes it";
    EXPECT_GE(rig.step().port_energy_min, -1e-9);
  }
}

// The hand moves a copy that receives no states. Then its peer gets the body: a copy within 50 mm
// keeps its pose, a farther one takes the granted pose.
TEST(HandedOverBody, StartsAtTheGrantedPoseIfFar) {
  for (const bool far : {false, true}) {
    SCOPED_TRACE(far);
    Rig rig(shoves);
    rig.world->disown(0);
    rig.step();
    BodyOrder copy{BodyAct::copy, 0, rig.cube()};
    copy.delay = std::numeric_limits<double>::infinity();
    rig.world->order(copy);
    const double way = far ? 0.055 : 0.03;
    while (rig.cube().position.x() < way) {
      rig.step();
      ASSERT_LT(rig.now, std::chrono::seconds(5));
    }
    rig.world->order({BodyAct::own, 0, {{0, 0, kHalf}, Eigen::Quaterniond::Identity()}});
    for (int i = 0; i < 5; ++i) EXPECT_GE(rig.step().port_energy_min, -1e-9);
    EXPECT_NEAR(rig.cube().position.x(), far ? 0.0 : way, 0.002);
  }
}

TEST(HandedOverBody, CostsNothingWhenPutAroundTheHand) {
  Rig rig([](double) { return HandTarget{{0.012, 0, 0.087}}; });
  rig.world->disown(0);
  for (int i = 0; i < 100; ++i) rig.step();
  ObjectMotion& motion = rig.mover->of(0);
  motion.position.z() = 0.0855;
  motion.orientation = Eigen::AngleAxisd(2.3, Vector3d(1, 2, 3).normalized());
  for (int i = 0; i < 1000; ++i) ASSERT_GE(rig.step().port_energy_min, -1e-9) << i;
}

// Slowly, so that the springs of hand and cube are in balance.
TEST(HandedOverBody, LiftsAHandByTheCorrectForce) {
  Rig rig([](double) { return HandTarget{{0, 0, 0.037}}; });
  rig.world->disown(0);
  for (int i = 0; i < 3'000; ++i) {
    const double rise = 0.005 * std::clamp(1e-3 * (i - 1000), 0.0, 1.0);
    if (i > 10) rig.mover->of(0).position.z() = kHalf + rise;
    if (i > 10) rig.mover->of(0).velocity.z() = i > 1000 && i < 2000 ? 0.005 : 0.0;
    rig.step();
  }
  constexpr double kGrip = 300.0, kSurface = 300.0;
  const double right = kGrip * kSurface / (kGrip + kSurface) * (2 * kHalf + 0.005 - 0.037);
  EXPECT_NEAR(rig.step().force.z(), right, 0.02 * right);
  EXPECT_GT(rig.step().tally.bodies, 2.5) << "time at bodies of other peers";
}

TEST(HandedOverBody, NeverCostsThePortEnergy) {
  int touched = 0;
  for (int seed = 1; seed <= test::tries(20, 400); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> any(-1, 1);
    Rig rig(seed % 2 == 0 ? HandScript(shoves) : HandScript(lifts));
    for (int i = 0; i < 3'000; ++i) {
      if (random() % 20 == 0) {
        ObjectMotion state = rig.cube();
        state.velocity += 0.3 * Vector3d(any(random), any(random), any(random));
        // As a new owner has it: some millimetres beside where it was shown.
        if (random() % 2 == 0) state.position += 0.003 * Vector3d(any(random), any(random), 0);
        rig.cube().carried ? rig.world->own(0, state) : rig.world->disown(0);
      }
      const ServoSnapshot& step = rig.step();
      ASSERT_GE(step.port_energy_min, -1e-9 - step.loan_most) << seed << " " << i;
      ASSERT_TRUE(step.force.allFinite());
      ASSERT_LT(step.force.norm(), 20.0) << seed << " " << i;
      touched += step.force.norm() > 0.1 ? 1 : 0;
      if (random() % 20 == 0) rig.now += nanoseconds(random() % 1'000'000);
    }
    const double given = -rig.device.port_work() - rig.device.damping_loss();
    EXPECT_LT(given, 0.008 + 0.2 * 3.2) << seed;
  }
  EXPECT_GT(touched, 1'000);
}

TEST(BodyStates, ShowWhatAHandHasTouchedLately) {
  for (const bool carried : {false, true}) {
    Rig rig([](double t) {
      HandTarget out{{0, 0, 0.06}};
      if (t > 0.1 && t < 0.6) out.position.z() = 0.037;
      return out;
    });
    if (carried) rig.world->disown(0);
    int first = -1, last = -1, released = -1;
    for (int i = 0; i < 2'000; ++i) {
      if (rig.step().force.z() > 1e-6) released = i;
      (void)rig.world->outgoing().update();
      if (!rig.world->outgoing().read().bodies[0].touched) continue;
      if (first < 0) first = i;
      last = i;
    }
    EXPECT_GT(first, 100);
    EXPECT_GT(released, 600);
    EXPECT_NEAR(last - released, 50, 3) << carried;
  }
}

}  // namespace
}  // namespace reckon::haptics::handed_over_body_test
