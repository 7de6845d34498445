// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Objects moved by the scene: no hand passes through them, and their energy to a hand is bounded.
// RECKON_SOAK=1 tries a million steps at each mesh.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics::carried_object_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

double seconds(nanoseconds time) { return std::chrono::duration<double>(time).count(); }

/// A function of time.
class Path final : public ObjectMover {
 public:
  explicit Path(std::function<ObjectMotion(double)> path) : path_(std::move(path)) {}
  ObjectMotion motion_of(std::uint32_t, nanoseconds now) noexcept override {
    return path_(seconds(now));
  }

 private:
  std::function<ObjectMotion(double)> path_;
};

ObjectMotion swing(const Vector3d& from, const Vector3d& by, double rate, double t) {
  ObjectMotion out;
  out.position = from + std::sin(rate * t) * by;
  out.velocity = rate * std::cos(rate * t) * by;
  return out;
}

Scene block(bool carried) {
  Scene scene;
  SceneObject& block = scene.objects.emplace_back();
  block.name = "block";
  block.shape = BoxShape{Vector3d(0.2, 0.2, 0.04)};
  block.effects.of<SpringDamper>() = {500, 0.0};
  block.carried = carried;
  return scene;
}

SimulatedDevice device_at(double height, double grip = 300) {
  SimulatedDeviceConfig config;
  config.mass = 0.1;
  config.damping = 1.0;
  config.hand_stiffness = grip;
  config.hand_damping = 3;
  config.start = {0, 0, 0.1};
  return SimulatedDevice(config, [height](double t) {
    HandTarget target;
    target.position.z() = 0.1 - (0.1 - height) * std::min(1.0, t);
    return target;
  });
}

// A hand with random motion at 0.5 m/s, against a mesh with an equally fast surface, with late
// steps.
void press_on(test::MeshData data, double size, unsigned seed) {
  const test::ScratchFolder folder;
  const SurfaceMesh mesh = test::make_mesh(data, size);
  test::write_obj(data, folder.file("mesh.obj"));
  Scene scene;
  SceneObject& object = scene.objects.emplace_back();
  object.name = "mesh";
  object.shape = MeshShape{folder.file("mesh.obj"), size, true};
  object.effects.of<SpringDamper>() = {500, 0.0};
  object.carried = true;
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Vector3d hand(0, 0, 0.3), wanted = hand;
  double time = 0.0;
  int touched = 0, passed = 0;
  const bool soaks = test::soaks();
  for (int i = 0; i < (soaks ? 1'000'000 : 30'000); ++i) {
    const double dt = i % 20 == 0 ? 1e-3 * (2.0 + any(random)) : 1e-3;
    time += dt;
    if (i % 150 == 0) wanted = 0.6 * size * Vector3d(any(random), any(random), any(random));
    const Vector3d way = wanted - hand;
    hand += std::min(1.0, 0.5 * dt / std::max(1e-9, way.norm())) * way;
    // 0.25 m/s of its middle, and the same at its rim by rotation.
    ObjectMotion motion = swing(Vector3d::Zero(), Vector3d(0.02, 0.01, 0.015), 9.3, time);
    const Vector3d axis = Vector3d(1, 0.3, -0.5).normalized();
    motion.orientation = Eigen::AngleAxisd(0.25 / (0.5 * size) * time, axis);
    solver.place(0, motion, motion);
    const ContactResult result = solver.step(hand, dt);
    touched += result.in_contact ? 1 : 0;
    if (!result.in_contact || i % (soaks ? 1 : 25) != 0) continue;
    const Vector3d at = motion.orientation.conjugate() * (result.scp - motion.position);
    passed += (soaks ? mesh.contains(at) : test::winding_number(mesh, at) > 0.5) ? 1 : 0;
  }
  EXPECT_EQ(passed, 0);
  EXPECT_GT(touched, 3'000);
}

TEST(CarriedObject, StopsEveryHandForAnyMesh) {
  press_on(test::torus(48, 24), 0.2, 1);
  press_on(test::groove(), 0.2, 2);
  press_on(test::fin(0.05), 0.2, 3);
  press_on(test::cube(), 0.15, 4);
}

TEST(CarriedObject, IsAWallAtRest) {
  const Scene still = block(false), carried = block(true);
  const auto wall = std::make_shared<const EffectPlan>(still);
  const auto plan = std::make_shared<const EffectPlan>(carried);
  const auto world = std::make_shared<BodyWorld>(
      *plan, still.gravity, std::make_shared<Path>([](double) { return ObjectMotion{}; }));
  SimulatedDevice one = device_at(0.01), other = device_at(0.01);
  ServoLoop at_wall(one, wall, ServoConfig{}), at_carried(other, plan, ServoConfig{}, world);
  double felt = 0.0;
  for (nanoseconds now(1'000'000'000); now < std::chrono::seconds(4);
       now += nanoseconds(1'000'000)) {
    at_wall.step(now);
    at_carried.step(now);
    (void)at_wall.snapshots().update();
    (void)at_carried.snapshots().update();
    ASSERT_EQ(at_wall.snapshots().read().force, at_carried.snapshots().read().force);
    felt = std::max(felt, at_wall.snapshots().read().force.z());
  }
  EXPECT_GT(felt, 1.0);
}

// Slowly, so that the springs of hand and surface are in balance and the power is small.
TEST(CarriedObject, LiftsAHandByTheCorrectForce) {
  const Scene scene = block(true);
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const double rate = 2 * std::numbers::pi * 0.1;
  const auto world =
      std::make_shared<BodyWorld>(*plan, scene.gravity, std::make_shared<Path>([rate](double t) {
        return swing(Vector3d::Zero(), Vector3d(0, 0, 0.004), rate, t);
      }));
  SimulatedDevice device = device_at(0.012);
  ServoLoop servo(device, plan, ServoConfig{}, world);
  for (nanoseconds now(1'000'000'000); now < std::chrono::seconds(20);
       now += nanoseconds(1'000'000)) {
    servo.step(now);
    (void)servo.snapshots().update();
    const ServoSnapshot& step = servo.snapshots().read();
    ASSERT_GE(step.port_energy_min, -1e-9) << seconds(now);
    if (now < std::chrono::seconds(3)) continue;
    const double surface = 0.02 + 0.004 * std::sin(rate * seconds(now));
    const double right = 500.0 * 300.0 / 800.0 * (surface - 0.012);
    ASSERT_NEAR(step.force.z(), right, 0.02 * right + 0.005) << seconds(now);
  }
}

// A block that strikes a hand gives at most the permitted power, for any timing of steps.
TEST(CarriedObject, GivesAHandAtMostItsLimit) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    const Scene scene = block(true);
    const auto plan = std::make_shared<const EffectPlan>(scene);
    const double rate = 5 + 40 * any(random), size = 0.5 / rate;
    const auto world =
        std::make_shared<BodyWorld>(*plan, scene.gravity, std::make_shared<Path>([=](double t) {
          ObjectMotion out = swing(Vector3d::Zero(), Vector3d(0, 0, size), rate, t);
          out.orientation = Eigen::AngleAxisd(3 * std::sin(2 * t), Vector3d::UnitZ());
          out.turn_rate = 6 * std::cos(2 * t) * Vector3d::UnitZ();
          return out;
        }));
    SimulatedDevice device = device_at(0.015, 50 + 400 * any(random));
    const ServoConfig config;
    ServoLoop servo(device, plan, config, world);
    nanoseconds now(1'000'000'000);
    const nanoseconds begin = now;
    double felt = 0.0;
    while (now - begin < std::chrono::seconds(10)) {
      servo.step(now);
      (void)servo.snapshots().update();
      const ServoSnapshot& step = servo.snapshots().read();
      const double given = -device.port_work() - device.damping_loss() - step.late_cost;
      ASSERT_LE(given, 0.008 + config.max_received_power * seconds(now - begin) + 1e-9)
          << "seed " << seed;
      ASSERT_GE(step.port_energy_min, -1e-9 - step.late_cost) << "seed " << seed;
      felt = std::max(felt, step.force.norm());
      const bool late = seed % 2 == 0 && random() % 20 == 0;
      now += late ? nanoseconds(1'000'000 + random() % 3'000'000) : nanoseconds(1'000'000);
    }
    EXPECT_GT(felt, 0.3) << "seed " << seed;
  }
}

TEST(CarriedObject, CarriesBodiesOnItsTop) {
  Scene scene = block(true);
  SceneObject& cube = scene.objects.emplace_back();
  cube.name = "cube";
  cube.shape = BoxShape{Vector3d::Constant(0.04)};
  cube.pose.position = {0.03, 0, 0.04};
  cube.effects.of<SpringDamper>() = {300, 0.0};
  cube.matter = {0.05, 0.6, 0.0};
  const EffectPlan plan(scene);
  // It rises, moves aside and turns; never faster than friction can follow.
  const auto path = [](double t) {
    ObjectMotion out;
    const double u = 0.5 - 0.5 * std::cos(t), du = 0.5 * std::sin(t);
    out.position = u * Vector3d(0.3, 0, 0.05);
    out.velocity = du * Vector3d(0.3, 0, 0.05);
    out.orientation = Eigen::AngleAxisd(u, Vector3d::UnitZ());
    out.turn_rate = du * Vector3d::UnitZ();
    return out;
  };
  BodyWorld world(plan, scene.gravity, std::make_shared<Path>(path));
  for (nanoseconds now(0); now <= nanoseconds(3'141'000'000); now += nanoseconds(1'000'000))
    world.advance_to(now);
  const ObjectMotion end = path(3.141);
  const Vector3d right = end.position + end.orientation * Vector3d(0.03, 0, 0.04);
  EXPECT_LT((world.states()[1].position - right).norm(), 5e-4);
  const Eigen::Quaterniond off = end.orientation.conjugate() * world.states()[1].orientation;
  EXPECT_LT(2 * off.vec().norm(), 0.01);
}

TEST(CarriedObject, NeedsAMover) {
  const Scene scene = block(true);
  const EffectPlan plan(scene);
  EXPECT_THROW(BodyWorld(plan, scene.gravity), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics::carried_object_test
