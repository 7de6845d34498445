// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body held by a hand: by a button, or because it sticks. Forces are compared with the same
// motion without sampling and with statics.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/held_cube.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics::grab_test {
namespace {

using Eigen::Vector3d;
using grabbed::cube_of;
using grabbed::device_at;
using grabbed::holding;
using grabbed::kHalf;
using grabbed::kT;
using grabbed::kWall;
using std::chrono::nanoseconds;

/// One hand, and the bodies of a scene.
struct Rig {
  Rig(const Scene& scene, const SimulatedDeviceConfig& held, const ServoConfig& servo_config,
      HandScript script)
      : plan(std::make_shared<const EffectPlan>(scene)),
        world(std::make_shared<BodyWorld>(*plan, scene.gravity)),
        device(held, std::move(script)),
        servo(device, plan, servo_config, world) {}

  const ServoSnapshot& step() {
    servo.step(now);
    now += nanoseconds(1'000'000);
    EXPECT_TRUE(servo.snapshots().update());
    return servo.snapshots().read();
  }
  const BodyState& body() const { return world->states()[0]; }

  std::shared_ptr<const EffectPlan> plan;
  std::shared_ptr<BodyWorld> world;
  SimulatedDevice device;
  ServoLoop servo;
  nanoseconds now{1'000'000'000};
};

// Down onto the cube on a floor, and up again with it.
HandTarget lifts(double t) {
  HandTarget out;
  const double down = std::min(t, 0.5) / 0.5, up = std::clamp((t - 1.0) / 1.0, 0.0, 1.0);
  out.position.z() = 0.05 - 0.02 * down + 0.2 * up * up * (3 - 2 * up);
  out.buttons = t > 0.8 ? 1 : 0;
  return out;
}

Scene cube_on_floor(double mass) {
  Scene scene = cube_of(mass, {0, 0, -9.81});
  scene.objects[0].pose.position.z() = kHalf;
  SceneObject& floor = scene.objects.emplace_back();
  floor.name = "floor";
  floor.shape = PlaneShape{};
  return scene;
}

// The weight stretches the spring; the hand carries it.
TEST(Grab, BodyHangsBelowTheHandByItsWeight) {
  constexpr double kSpring = 250.0, kMass = 1.0;
  Rig rig(cube_on_floor(kMass), device_at({0, 0, 0.05}), holding(kSpring, 1.0), lifts);
  std::optional<double> begun;
  for (int i = 0; i < 8'000; ++i) {
    const ServoSnapshot& step = rig.step();
    if (step.held.number > 0 && !begun) begun = step.device.z() - rig.body().position.z();
    ASSERT_GE(step.port_energy_min, -1e-9 - step.loan_most);
  }
  ASSERT_TRUE(begun);
  const ServoSnapshot& last = rig.step();
  EXPECT_EQ(last.held.number, 1);
  EXPECT_GT(rig.body().position.z(), 0.1);
  const double sag = last.device.z() - rig.body().position.z() - *begun;
  EXPECT_NEAR(sag, kMass * 9.81 / kSpring, 0.01 * kMass * 9.81 / kSpring);
  EXPECT_NEAR(-last.force.z(), kMass * 9.81, 0.01 * kMass * 9.81);
  EXPECT_LT(rig.body().velocity.norm(), 5e-3);
  EXPECT_GT(last.tally.grabbed, 7.0);
}

TEST(Grab, NeedsTheButtonAndReleasesTheBody) {
  const auto released = [](double t) {
    HandTarget out = lifts(t);
    if (t > 3.0) out.buttons = 0;
    return out;
  };
  Rig rig(cube_on_floor(0.1), device_at({0, 0, 0.05}), holding(250, 0.5), released);
  double highest = 0.0;
  for (int i = 0; i < 6'000; ++i) {
    rig.step();
    highest = std::max(highest, rig.body().position.z());
  }
  EXPECT_GT(highest, 0.15);
  EXPECT_NEAR(rig.body().position.z(), kHalf, 1e-4);
  EXPECT_EQ(rig.step().held.number, 0);

  const auto other = [](double t) {
    HandTarget out = lifts(t);
    out.buttons *= 2;  // another button
    return out;
  };
  Rig idle(cube_on_floor(0.1), device_at({0, 0, 0.05}), holding(250, 0.5), other);
  for (int i = 0; i < 4'000; ++i) EXPECT_EQ(idle.step().held.number, 0);
  EXPECT_NEAR(idle.body().position.z(), kHalf, 1e-4);
}

/// The hand comes from below, holds the cube from the first touch on, and moves it up and down.
double pumped(double t) {
  const double near = std::min(t, 1.0);
  const double pump = t > 1.5 ? 0.02 * std::sin(2 * std::numbers::pi * 1.5 * (t - 1.5)) : 0.0;
  return -0.03 + 0.0101 * near + pump;
}
HandTarget pumps(double t) {
  HandTarget out;
  out.position.z() = pumped(t);
  out.velocity.z() = (pumped(t + 1e-4) - pumped(t - 1e-4)) / 2e-4;
  out.buttons = 1;
  return out;
}

/// The same in steps of 10 us. @return the mean force on the hand of each millisecond [N]
std::vector<double> truth(double mass, double wall, double spring, double viscosity, double end) {
  constexpr double kStep = 1e-5;
  std::vector<double> out;
  double x = pumped(0), v = 0, body = 0, speed = 0;
  std::optional<double> held;
  for (long i = 0; i < std::lround(end / kStep); ++i) {
    const double t = static_cast<double>(i) * kStep;
    const double depth = std::max(0.0, x - (body - kHalf));
    if (i % 100 == 0 && depth > 0 && !held) held = x - body;
    double force = -wall * depth;
    if (held) force -= spring * (x - body - *held) + viscosity * (v - speed);
    if (i % 100 == 0) out.push_back(0.0);
    out.back() += force / 100;
    const HandTarget goal = pumps(t);
    const double pull = 300 * (goal.position.z() - x) + 3 * (goal.velocity.z() - v);
    v += kStep / 0.1 * (force - 3 * v + pull);
    speed += kStep / mass * -force;
    x += kStep * v;
    body += kStep * speed;
  }
  return out;
}

TEST(Grab, IsFeltAsWithoutSampling) {
  for (const double mass : {0.003, 0.01, 0.05, 0.2, 1.0}) {
    const Scene scene = cube_of(mass);
    const double wall = std::min(kWall, stiffest_push(mass, kT));
    const double spring = std::min(200.0, 0.5 * stiffest_push(mass, kT));
    const double viscosity = 0.05 * mass / kT;
    Rig rig(scene, device_at({0, 0, pumped(0)}), holding(spring, std::min(0.5, viscosity)), pumps);
    const std::vector<double> same = truth(mass, wall, spring, std::min(0.5, viscosity), 8);
    double error = 0, size = 0, made = -1e9;
    for (const double force : same) {
      const ServoSnapshot& step = rig.step();
      error += std::pow(step.force.z() - force, 2);
      size += force * force;
      EXPECT_GE(step.port_energy_min, -1e-9);
      made = std::max(made, step.loan_most);
    }
    std::printf("%5.3f kg: force error %.2f %% of %.2f N rms, lent %.2g J\n", mass,
                100 * std::sqrt(error / size), std::sqrt(size / static_cast<double>(same.size())),
                made);
    EXPECT_LT(std::sqrt(error / size), mass > 0.01 ? 0.01 : 0.03) << mass;
  }
}

// Held or pushed, also with a device too weak for the spring: the body gets only the rendered
// force.
TEST(Grab, BodyGetsTheForceOfTheHand) {
  constexpr double kMass = 0.5;
  for (const auto& [spring, most] :
       {std::pair{250.0, 0.3}, {250.0, 1.0}, {250.0, 30.0}, {0.0, 0.1}, {0.0, 30.0}}) {
    SimulatedDeviceConfig config = device_at({0, 0, pumped(0)});
    config.max_force = most;
    Rig rig(cube_of(kMass), config, holding(spring, 0.5), pumps);
    double given = 0.0, passed = 0.0, cut = 1.0;
    for (int i = 0; i < 6'000; ++i) {
      const ServoSnapshot& step = rig.step();
      EXPECT_NEAR(kMass * rig.body().velocity.z(), -given, 2e-3 * passed + 1e-6) << i << " ms";
      given += kT * step.force.z();
      passed += kT * std::abs(step.force.z());
      cut = std::min(cut, step.limit_share);
    }
    EXPECT_GT(passed, spring > 0 ? 0.2 : 0.01);
    EXPECT_TRUE(most > 0.5 || cut < 0.8) << cut;
  }
}

// Pulled slowly, so that inertia adds little.
TEST(Grab, StickingBodyIsTornOffAtItsLimit) {
  Scene scene = cube_on_floor(0.5);
  scene.objects[0].grab = {200.0, 0.0, 1.5};
  const auto lift = [](double t) {
    HandTarget out = lifts(t);
    out.buttons = 0;
    return out;
  };
  Rig rig(scene, device_at({0, 0, 0.05}), ServoConfig{}, lift);
  double most = 0.0;
  bool stuck = false;
  for (int i = 0; i < 4'000; ++i) {
    const ServoSnapshot& step = rig.step();
    stuck |= step.held.number > 0;
    most = std::max(most, -step.force.z());
  }
  EXPECT_TRUE(stuck);
  EXPECT_NEAR(most, 1.5, 0.05);
  EXPECT_EQ(rig.step().held.number, 0);
  EXPECT_NEAR(rig.body().position.z(), kHalf, 1e-4);

  scene.objects[0].grab.most = 8.0;
  Rig held(scene, device_at({0, 0, 0.05}), ServoConfig{}, lift);
  for (int i = 0; i < 4'000; ++i) held.step();
  EXPECT_EQ(held.step().held.number, 1);
  EXPECT_GT(held.body().position.z(), 0.1);
}

// After a cut the hand is at another place.
TEST(Grab, CutForceReleasesTheBody) {
  Rig rig(cube_on_floor(0.1), device_at({0, 0, 0.05}), holding(250, 0.5), lifts);
  for (int i = 0; i < 3'000; ++i) rig.step();
  ASSERT_EQ(rig.step().held.number, 1);
  rig.device.plug(false);
  for (int i = 0; i < 100; ++i) rig.step();
  rig.device.plug(true);
  for (int i = 0; i < 2'000; ++i) rig.step();
  EXPECT_EQ(rig.step().held.number, 0) << "the button is still pressed, but nothing is touched";
  EXPECT_NEAR(rig.body().position.z(), kHalf, 1e-4);
}

// A moving object of the scene and a fixed one are not held.
TEST(Grab, HoldsBodiesOnly) {
  Scene scene = cube_on_floor(0.1);
  scene.objects[0].matter.mass = 0.0;
  Rig rig(scene, device_at({0, 0, 0.05}), holding(250, 0.5), lifts);
  for (int i = 0; i < 4'000; ++i) EXPECT_EQ(rig.step().held.number, 0);
}

// Two probes of a turning tool hold a bar at both ends, and turn it.
TEST(Grab, TurningToolTurnsTheHeldBody) {
  Scene scene = cube_of(0.1);
  scene.objects[0].shape = BoxShape{Vector3d(0.1, 0.02, 0.02)};
  SimulatedDeviceConfig config = device_at({0, 0, 0.011});
  config.hand_stiffness = 1000;
  SimulatedTurnConfig& turn = config.turn.emplace();
  turn.damping = 0.05;
  turn.max_torque = 2;
  turn.hand_stiffness = 2.0;
  turn.hand_damping = 0.05;
  ServoConfig servo_config = holding(250, 0.5);
  servo_config.probes = {{-0.04, 0, 0}, {0.04, 0, 0}};
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
  const auto script = [](double t) {
    HandTarget out;
    out.position.z() = 0.011 - 0.0015 * std::min(1.0, t / 0.2);
    out.buttons = 1;
    return out;
  };
  const auto turns = [](double t) {
    const double angle = 0.8 * std::clamp((t - 1.0) / 2.0, 0.0, 1.0);
    DeviceTurn out;
    out.orientation = Eigen::AngleAxisd(angle, Vector3d::UnitZ());
    return out;
  };
  SimulatedDevice device(config, script, turns);
  ServoLoop servo(device, plan, servo_config, world);
  for (int i = 0; i < 6'000; ++i) {
    servo.step(nanoseconds(1'000'000'000 + 1'000'000L * i));
    ASSERT_TRUE(servo.snapshots().update());
    ASSERT_GE(servo.snapshots().read().port_energy_min, -1e-9);
  }
  const double turned = Eigen::AngleAxisd(world->states()[0].orientation).angle();
  EXPECT_TRUE(servo.snapshots().read().held.number > 0);
  EXPECT_NEAR(turned, 0.8, 0.03);
}

TEST(Grab, AllocatesNothing) {
  Rig rig(cube_on_floor(0.1), device_at({0, 0, 0.05}), holding(250, 0.5), lifts);
  for (int i = 0; i < 1'500; ++i) rig.step();
  const test::AllocationGuard guard;
  for (int i = 0; i < 2'000; ++i) rig.step();
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace reckon::haptics::grab_test
