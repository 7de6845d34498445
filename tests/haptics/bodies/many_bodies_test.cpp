// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Worlds with more bodies than can be awake at one time: sleeping bodies rest, wake on contact, and
// then behave as if always awake.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::many_bodies_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr nanoseconds kStep = std::chrono::milliseconds(1);
constexpr double kEdge = 0.04, kPitch = 0.1;  // [m]
constexpr double kRestDepth = 1e-5;           // [m], at which contacts rest
constexpr double kMass = 0.1, kFriction = 0.5, kG = 9.81;

/// Cubes in rows on a floor.
class Field {
 public:
  explicit Field(int rows, int in_row) : rows_(rows), in_row_(in_row) {
    SceneObject& floor = scene_.objects.emplace_back();
    floor.name = "floor";
    floor.shape = PlaneShape{Vector3d::UnitZ()};
    floor.matter.friction = kFriction;
    for (int row = 0; row < rows; ++row)
      for (int i = 0; i < in_row; ++i) add({kPitch * i, 0.5 * row, 0.5 * kEdge - kRestDepth});
  }
  SceneObject& add(const Vector3d& at) {
    SceneObject& box = scene_.objects.emplace_back();
    box.name = "box " + std::to_string(scene_.objects.size());
    box.shape = BoxShape{Vector3d::Constant(kEdge)};
    box.pose.position = at;
    box.matter = {kMass, kFriction, 0.0};
    return box;
  }
  /// Not stepped yet.
  std::shared_ptr<BodyWorld> begin_shared() {
    for (SceneObject& object : scene_.objects) object.effects.of<SpringDamper>() = {400.0, 0.0};
    plan_ = std::make_shared<const EffectPlan>(scene_);
    world_ = std::make_shared<BodyWorld>(*plan_, scene_.gravity);
    return world_;
  }
  BodyWorld& begin() {
    begin_shared()->advance_to(now_);
    return *world_;
  }
  [[nodiscard]] std::shared_ptr<const EffectPlan> plan() const { return plan_; }
  void step() { world_->advance_to(now_ += kStep); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  /// An impulse that gives the body this speed along its row [m/s].
  void strike(std::size_t body, double speed) {
    const BodyState& at = world_->states()[body];
    world_->push(body, at.position, Vector3d(kMass * speed / 1e-3, 0, 0));
  }
  [[nodiscard]] std::size_t first_of(int row) const {
    return static_cast<std::size_t>(row * in_row_);
  }
  [[nodiscard]] double moved(std::size_t body) const {
    return (world_->states()[body].position - plan_->objects()[body + 1].position).norm();
  }
  [[nodiscard]] std::ptrdiff_t awake() const {
    return std::ranges::count_if(world_->states(), &BodyState::awake);
  }
  [[nodiscard]] int rows() const { return rows_; }

 private:
  int rows_, in_row_;
  Scene scene_;
  std::shared_ptr<const EffectPlan> plan_;
  std::shared_ptr<BodyWorld> world_;
  nanoseconds now_{1'000'000'000};
};

// A row moves the same with or without a thousand sleeping others beside it.
TEST(ManyBodies, MoveIndependentlyOfSleepingOthers) {
  Field alone(1, 4), among(250, 4);
  alone.begin(), among.begin();
  alone.run(2500);  // like the others, it begins asleep
  EXPECT_EQ(alone.awake(), 0);
  EXPECT_EQ(among.awake(), 0);
  const int row = 123;
  alone.strike(0, 2.0), among.strike(among.first_of(row), 2.0);
  std::ptrdiff_t most = 0;
  double worst = 0.0;
  for (int i = 0; i < 3000; ++i) {
    alone.step(), among.step();
    most = std::max(most, among.awake());
    for (std::size_t k = 0; k < 4; ++k)
      worst = std::max(worst, std::abs(alone.moved(k) - among.moved(among.first_of(row) + k)));
  }
  EXPECT_GT(alone.moved(1), 0.01);  // it was hit
  EXPECT_LT(worst, 2e-6);           // the single row has settled by a fraction of its rest depth
  EXPECT_LE(most, 4);
  EXPECT_EQ(among.awake(), 0);
  for (std::size_t i = 0; i < 1000; ++i) ASSERT_TRUE(i / 4 == row || among.moved(i) == 0.0) << i;
}

// A hand that pushes a cube along its row into the next one, and returns over others.
TEST(ManyBodies, FeelTheSameBesideSleepingOthers) {
  struct Felt {
    explicit Felt(Field& field) : world(field.begin_shared()) {
      SimulatedDeviceConfig config;
      config.damping = 2.0;
      config.start = {-0.05, 0.0, 0.5 * kEdge};
      device.emplace(config, [](double t) {
        return HandTarget{{-0.05 + 0.12 * (1 - std::cos(2.5 * std::max(0.0, t - 2.0))),
                           0.004 * std::sin(40.0 * t), 0.5 * kEdge}};
      });
      servo.emplace(*device, field.plan(), ServoConfig{}, world);
    }
    Vector3d step() {
      servo->step(now += kStep);
      (void)servo->snapshots().update();
      return servo->snapshots().read().force;
    }
    std::shared_ptr<BodyWorld> world;
    std::optional<SimulatedDevice> device;
    std::optional<ServoLoop> servo;
    nanoseconds now{1'000'000'000};
  };
  Field near(1, 3), all(200, 3);
  Felt alone(near), among(all);
  double most = 0.0, worst = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const Vector3d one = alone.step(), other = among.step();
    most = std::max(most, one.norm());
    worst = std::max(worst, (one - other).norm());
  }
  EXPECT_GT(most, 0.4);
  EXPECT_LT(worst, 0.005);
  EXPECT_GT(near.moved(1), 0.02);
  EXPECT_NEAR(near.moved(1), all.moved(1), 1e-3);
  for (std::size_t i = 3; i < 600; ++i) ASSERT_EQ(all.moved(i), 0.0) << i;
}

// One after the other: slots pass on from bodies that sleep again.
TEST(ManyBodies, SlideInTurnAsFarAsFrictionAllows) {
  Field field(test::tries(120, 300), 1);
  BodyWorld& world = field.begin();
  const double speed = 1.0;
  for (int row = 0; row < field.rows(); ++row) {
    field.strike(field.first_of(row), speed);
    field.run(40);
  }
  field.run(2000);
  EXPECT_EQ(world.crowded(), 0u);
  for (int row = 0; row < field.rows(); ++row)
    ASSERT_NEAR(field.moved(field.first_of(row)), speed * speed / (2 * kFriction * kG), 2e-3)
        << row;
  EXPECT_EQ(field.awake(), 0);
}

// At most as many wake as there are slots; a body that did not wake is a wall, and is counted.
TEST(ManyBodies, ActAsWallsWhenTheLimitIsReached) {
  Field field(100, 2);
  BodyWorld& world = field.begin();
  for (int row = 0; row < field.rows(); ++row) field.strike(field.first_of(row), 3.0);
  std::ptrdiff_t most = 0;
  for (int i = 0; i < 400; ++i) {
    field.step();
    most = std::max(most, field.awake());
    for (int row = 0; row < field.rows(); ++row) {
      const Vector3d& first = world.states()[field.first_of(row)].position;
      const Vector3d& second = world.states()[field.first_of(row) + 1].position;
      ASSERT_GT(second.x() - first.x(), kEdge - 3e-3) <<  // one step of its motion
          "row " << row << " step " << i;
    }
  }
  EXPECT_EQ(most, 64);
  EXPECT_GT(world.crowded(), 0u);
}

TEST(ManyBodies, StopABulletWhileAsleep) {
  for (const double speed : {10.0, 30.0, 100.0, 190.0}) {
    Field field(100, 1);
    SceneObject& plate = field.add({1.0, 0.0, 0.5});
    plate.shape = BoxShape{Vector3d(0.001, 0.4, 0.4)};
    plate.matter.mass = 50.0;
    SceneObject& bullet = field.add({0.5, 0.0, 0.5});
    bullet.shape = SphereShape{0.005};
    bullet.matter = {kMass, 0.0, 0.0};
    BodyWorld& world = field.begin();
    field.strike(101, speed);
    for (int i = 0; i < 300; ++i) {
      field.step();
      ASSERT_LT(world.states()[101].position.x(), world.states()[100].position.x()) << speed;
    }
    EXPECT_GT(field.moved(100), 1e-3) << speed;  // it was hit
  }
}

// A copy that was not written for a long time contains all motion since.
TEST(ManyBodies, ArePublishedWholeAtAnyReadRate) {
  Field field(test::tries(240, 600), 1);
  BodyWorld& world = field.begin();
  const int sixth = field.rows() / 6;
  int reads = 0;
  for (int row = 0; row < field.rows(); ++row) {
    field.strike(field.first_of(row), 1.0);
    field.run(row < 5 * sixth ? 25 : 1);
    if (row % 7 != 0 && row < 4 * sixth) continue;
    ++reads;
    ASSERT_TRUE(world.published().update());
    const BodyStates& read = world.published().read();
    for (std::size_t i = 0; i < world.states().size(); ++i) {
      ASSERT_EQ(read.bodies[i].position, world.states()[i].position) << i;
      ASSERT_EQ(read.bodies[i].awake, world.states()[i].awake) << i;
    }
  }
  EXPECT_GT(reads, sixth);
  ASSERT_TRUE(world.outgoing().update());  // read for the first time
  for (std::size_t i = 0; i < world.states().size(); ++i)
    ASSERT_EQ(world.outgoing().read().bodies[i].position, world.states()[i].position) << i;
}

TEST(ManyBodies, WakeAndSleepWithoutAllocation) {
  const int rows = test::tries(40, 100);
  Field field(2 * rows, 2);
  field.begin();
  for (int row = 0; row < rows; ++row) {
    field.strike(field.first_of(row), 1.5);
    field.run(40);
  }
  const test::AllocationGuard guard;
  for (int row = rows; row < 2 * rows; ++row) {
    field.strike(field.first_of(row), 1.5);
    field.run(40);
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics::many_bodies_test
