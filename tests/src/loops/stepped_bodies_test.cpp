// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of a peer without a hand, stepped by passes of its model loop.
#include "reckon/peer/loops/stepped_bodies.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <random>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using haptics::BodyAct;
using haptics::BodyOrder;
using haptics::ObjectMotion;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Comes along x at 1 m/s, from the start of the clock on.
class Comer final : public haptics::ObjectMover {
 public:
  ObjectMotion motion_of(std::uint32_t, nanoseconds now) noexcept override {
    ObjectMotion out;
    const double t = std::chrono::duration<double>(now - begin_).count();
    out.position = {-5 + t, 0, 0.02};
    out.velocity = {1, 0, 0};
    return out;
  }

 private:
  nanoseconds begin_ = std::chrono::seconds(1);
};

/// A cube above a floor, and a second one of another peer on demand.
struct Bodies {
  explicit Bodies(double height, bool comes = false) {
    haptics::SceneObject& floor = scene.objects.emplace_back();
    floor.name = "floor";
    floor.shape = haptics::PlaneShape{Vector3d::UnitZ()};
    for (int i = 0; i < (comes ? 2 : 1); ++i) {
      haptics::SceneObject& cube = scene.objects.emplace_back();
      cube.name = i == 0 ? "cube" : "comer";
      cube.shape = haptics::BoxShape{Vector3d::Constant(0.04)};
      cube.pose.position = {i == 0 ? 0.0 : -5.0, 0, i == 0 ? height : 0.02};
      cube.matter = {0.05, 0.3, 0.0};
      cube.carried = i == 1;
    }
    const haptics::EffectPlan plan(scene);
    world = std::make_unique<haptics::BodyWorld>(plan, scene.gravity,
                                                 comes ? std::make_shared<Comer>() : nullptr);
    stepped.emplace(*world);
    stepped->step(now, false);
  }
  void pass(nanoseconds after, bool frozen = false) { stepped->step(now += after, frozen); }
  [[nodiscard]] const haptics::BodyState& cube() const { return world->states()[0]; }

  haptics::Scene scene;
  std::unique_ptr<haptics::BodyWorld> world;
  std::optional<SteppedBodies> stepped;
  nanoseconds now = std::chrono::seconds(1);
};

TEST(SteppedBodies, FallAndThenCostNothing) {
  Bodies bodies(0.12);
  int passes = 0;
  while (bodies.stepped->next_step() < nanoseconds::max()) {
    ASSERT_EQ(bodies.stepped->next_step(), bodies.now + milliseconds(1));
    bodies.pass(milliseconds(1));
    ASSERT_LT(++passes, 3000);
  }
  EXPECT_GT(passes, 1000);
  EXPECT_NEAR(bodies.cube().position.z(), 0.02, 1e-4);
  EXPECT_FALSE(bodies.cube().awake);
  const auto published = bodies.world->outgoing().update();
  EXPECT_TRUE(published);
  for (int i = 0; i < 100; ++i) bodies.pass(milliseconds(50));
  EXPECT_FALSE(bodies.world->outgoing().update());
}

TEST(SteppedBodies, MoveTheSameForAnyTimesOfPasses) {
  Bodies regular(0.12), drawn(0.12);
  std::mt19937 random(1);
  while (drawn.now < std::chrono::milliseconds(1900)) {
    drawn.pass(nanoseconds(random() % 60'000'000));
    while (drawn.now - regular.now >= milliseconds(1)) regular.pass(milliseconds(1));
    ASSERT_EQ(drawn.cube().position, regular.cube().position);
  }
}

TEST(SteppedBodies, MakeUpForATenthOfASecond) {
  Bodies bodies(1.0);
  bodies.pass(std::chrono::seconds(10));
  EXPECT_NEAR(bodies.cube().position.z(), 1.0 - 0.5 * 9.81 * 0.01, 1e-6);
}

TEST(SteppedBodies, ObeyOrdersWhileTheyRest) {
  Bodies bodies(0.02);
  while (bodies.stepped->next_step() < nanoseconds::max()) bodies.pass(milliseconds(1));
  bodies.pass(milliseconds(777));
  BodyOrder order{BodyAct::own, 0};
  order.state.position = {0.3, 0, 0.5};
  order.state.velocity = {1, 0, 0};
  ASSERT_NE(bodies.world->exchange().send(std::span(&order, 1)), 0u);
  EXPECT_LE(bodies.stepped->next_step(), bodies.now + milliseconds(1));
  bodies.pass(milliseconds(20));
  EXPECT_NEAR(bodies.cube().position.x(), 0.301, 1e-12);
  EXPECT_EQ(bodies.stepped->next_step(), bodies.now + milliseconds(1));
}

TEST(SteppedBodies, WakeWhenACarriedBodyComes) {
  Bodies bodies(0.02, true);
  int passes = 0;
  for (int i = 0; i < 20'000 && bodies.now < std::chrono::milliseconds(6000); ++i, ++passes) {
    const bool is_due = bodies.stepped->next_step() < bodies.now + milliseconds(50);
    bodies.pass(is_due ? milliseconds(1) : milliseconds(50));
  }
  EXPECT_LT(passes, 3300) << "most of the way costs passes of 50 ms";
  EXPECT_GT(bodies.cube().position.x(), 0.03);
}

TEST(SteppedBodies, StandWhileFrozen) {
  Bodies bodies(1.0);
  for (int i = 0; i < 100; ++i) bodies.pass(milliseconds(1), true);
  EXPECT_EQ(bodies.cube().position.z(), 1.0);
  for (int i = 0; i < 10; ++i) bodies.pass(milliseconds(1));
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) bodies.pass(milliseconds(1));
  EXPECT_LT(bodies.cube().position.z(), 0.96);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::peer
