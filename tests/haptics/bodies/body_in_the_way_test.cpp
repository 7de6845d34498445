// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body that meets a hand: on a floor, frozen, in its fall, and moving towards the hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <random>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/squeezed_cube.hpp"

namespace reckon::haptics::body_in_the_way_test {
namespace {

using Eigen::Vector3d;
using squeezed::cube_of;
using squeezed::device_at;
using squeezed::ease;
using squeezed::kHalf;
using squeezed::kT;
using squeezed::target;
using std::chrono::nanoseconds;

// A body against something at rest does not yield, however light it is.
TEST(PushedBody, IsAWallOnTheFloor) {
  for (const double mass : {0.001, 0.01, 0.1, 1.0}) {
    Scene scene = cube_of(mass, 500);
    scene.gravity = {0, 0, -9.81};
    scene.objects[0].pose.position.z() = kHalf;
    SceneObject& floor = scene.objects.emplace_back();
    floor.name = "floor";
    floor.shape = PlaneShape{Vector3d::UnitZ()};
    floor.effects.of<SpringDamper>() = {400, 0.0};
    const auto plan = std::make_shared<const EffectPlan>(scene);
    const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
    const auto down = [](double t) {
      HandTarget target;
      target.position.z() = 2 * kHalf + 0.01 - 0.02 * ease(t);
      return target;
    };
    SimulatedDevice device(device_at(down(0).position), down);
    ServoLoop servo(device, plan, ServoConfig{}, world);
    for (int i = 0; i < 3000; ++i) servo.step(nanoseconds(1'000'000'000 + 1'000'000L * i));
    ASSERT_TRUE(servo.snapshots().update());
    const ServoSnapshot& step = servo.snapshots().read();
    // The hand's spring of 300 N/m has its goal 10 mm inside a surface of 500 N/m.
    const double right = 500.0 * 300.0 / 800.0 * 0.01;
    EXPECT_NEAR(step.force.z(), right, 0.005 * right) << mass << " kg";
    EXPECT_NEAR(world->states()[0].position.z(), kHalf, 1e-4) << mass << " kg";
  }
}

// A hand that pushes a cube over a floor with friction feels that friction, mu m g.
TEST(PushedBody, IsPushedAgainstFriction) {
  for (const double mass : {0.005, 0.05, 0.5}) {
    Scene scene = cube_of(mass, 500);
    scene.gravity = {0, 0, -9.81};
    scene.objects[0].pose.position.z() = kHalf;
    scene.objects[0].matter.friction = 0.5;
    SceneObject& floor = scene.objects.emplace_back();
    floor.name = "floor";
    floor.shape = PlaneShape{Vector3d::UnitZ()};
    floor.effects.of<SpringDamper>() = {400, 0.0};
    floor.matter.friction = 0.5;
    const auto plan = std::make_shared<const EffectPlan>(scene);
    const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
    const auto along = [](double t) {
      HandTarget target;
      target.position = {-0.03 + 0.05 * t, 0, 0.3 * kHalf};  // below the middle: it does not tip
      return target;
    };
    SimulatedDevice device(device_at(along(0).position), along);
    ServoLoop servo(device, plan, ServoConfig{}, world);
    double sum = 0.0;
    for (int i = 0; i < 4000; ++i) {
      servo.step(nanoseconds(1'000'000'000 + 1'000'000L * i));
      ASSERT_TRUE(servo.snapshots().update());
      if (i >= 2000) sum -= servo.snapshots().read().force.x() / 2000;
    }
    const double right = 0.5 * mass * 9.81;
    EXPECT_NEAR(sum, right, 0.02 * right) << mass << " kg";
  }
}

TEST(PushedBody, StandsStillWhileTheSimulationIsFrozen) {
  Scene scene = cube_of(0.05, 400);
  scene.gravity = {0, 0, -9.81};
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
  SimulatedDevice device(device_at(Vector3d(0, 0, 0.2)));
  ServoLoop servo(device, plan, ServoConfig{}, world);
  nanoseconds now{1'000'000'000};
  const auto run = [&](int steps, bool frozen) {
    ContactSet set;
    set.frozen = frozen;
    servo.contacts().write(set);
    for (int i = 0; i < steps; ++i) servo.step(now += nanoseconds(1'000'000));
  };
  run(100, false);
  const double fell = world->states()[0].position.z();
  EXPECT_NEAR(fell, -0.5 * 9.81 * 0.01, 1e-3);
  run(1, true);
  const double stands = world->states()[0].position.z();
  run(500, true);
  EXPECT_EQ(world->states()[0].position.z(), stands);
  run(1, false);
  const double on = world->states()[0].position.z();
  run(50, false);
  EXPECT_NEAR(world->states()[0].position.z(), on - 9.81 * (0.1 * 0.05 + 0.5 * 0.0025), 1e-3)
      << "it falls on as fast as it was";
}

// For any mass, from either side.
TEST(PushedBody, IsAWallWhileTheSimulationIsFrozen) {
  const Scene scene = cube_of(0.001, 500);
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
  const auto in = [](double t) {
    HandTarget target;
    target.position.x() = -0.03 + 0.02 * ease(t);
    return target;
  };
  SimulatedDevice device(device_at(in(0).position), in);
  ServoLoop servo(device, plan, ServoConfig{}, world);
  ContactSet set;
  set.frozen = true;
  servo.contacts().write(set);
  for (int i = 0; i < 3000; ++i) servo.step(nanoseconds(1'000'000'000 + 1'000'000L * i));
  ASSERT_TRUE(servo.snapshots().update());
  // The hand's spring of 300 N/m has its goal 10 mm inside a surface of 500 N/m.
  const double right = 500.0 * 300.0 / 800.0 * 0.01;
  EXPECT_NEAR(-servo.snapshots().read().force.x(), right, 0.005 * right);
  EXPECT_EQ(world->states()[0].position, Vector3d::Zero());
  EXPECT_EQ(world->states()[0].velocity, Vector3d::Zero());
}

// The world advances by a whole period after the hands' forces are written. If the next step comes
// sooner the world is ahead by the difference; if it comes up to 50 us later, behind.
TEST(PushedBody, FallsBesideAHandAsTheClosedForm) {
  Scene scene = cube_of(0.05, 400);
  scene.gravity = {0, 0, -9.81};
  const auto plan = std::make_shared<const EffectPlan>(scene);
  for (const long jitter : {0L, 40'000L, 400'000L, 20'000'000L}) {
    const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
    SimulatedDevice device(device_at(Vector3d(0, 0.5, 0)));
    ServoLoop servo(device, plan, ServoConfig{}, world);
    std::mt19937 random(7);
    nanoseconds now{1'000'000'000};
    const long soonest = std::min(jitter, 800'000L) / 2;
    const double off = jitter > 0 ? 1e-9 * static_cast<double>(std::max(soonest, 50'000L)) : 0.0;
    for (int i = 0; i < 300; ++i) {
      servo.step(now);
      const double t = 1e-9 * static_cast<double>((now - nanoseconds(1'000'000'000)).count());
      const double z = world->states()[0].position.z();
      EXPECT_NEAR(z, -0.5 * 9.81 * t * t, 1e-9 + 9.81 * off * (t + off))
          << jitter << " ns, step " << i;
      now += nanoseconds(1'000'000 - soonest);
      if (jitter > 0) now += nanoseconds(static_cast<long>(random()) % jitter);
    }
  }
}

// A cube thrown at a resting hand: the hand feels it.
TEST(PushedBody, MeetsARestingHand) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Scene scene = cube_of(0.2, 800);
    scene.objects[0].pose.orientation = Eigen::Quaterniond(
        Eigen::AngleAxisd(any(random), Vector3d(any(random), 1, any(random)).normalized()));
    const Vector3d from = Vector3d(any(random), any(random), any(random)).normalized();
    scene.objects[0].pose.position = -0.1 * from;
    const auto plan = std::make_shared<const EffectPlan>(scene);
    const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
    SimulatedDevice device(device_at(Vector3d::Zero()));
    ServoLoop servo(device, plan, ServoConfig{}, world);
    nanoseconds now{1'000'000'000};
    servo.step(now);
    world->push(0, -0.1 * from, 0.2 * 0.5 / kT * from);  // 0.5 m/s
    double felt = 0.0, made = -1e9;
    for (int i = 0; i < 1000; ++i) {
      servo.step(now += nanoseconds(1'000'000));
      EXPECT_TRUE(servo.snapshots().update());
      felt = std::max(felt, servo.snapshots().read().force.norm());
      made = std::max(made, world->energy() - device.port_work() - device.damping_loss() - 0.025);
    }
    EXPECT_GT(felt, 1.0) << "seed " << seed << ": it flew through the hand";
    EXPECT_LE(made, 1e-6) << "seed " << seed;
  }
}

}  // namespace
}  // namespace reckon::haptics::body_in_the_way_test
