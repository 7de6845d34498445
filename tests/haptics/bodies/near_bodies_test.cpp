// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand gets each body that it may meet, even after late steps; compared with an exhaustive
// search.
#include "reckon/haptics/bodies/near_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::near_bodies_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kRadius = 0.01;  // [m], of a ball
constexpr double kRoom = 0.25;    // [m]
constexpr double kPeriod = 1e-3;  // [s]
constexpr double kAhead = 1e-4;   // [s], a hand may step so much too early, or too late
constexpr double kSoon = 3.0;     // periods of the hand's look-ahead

Scene of_bouncing_balls(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Scene scene;
  scene.gravity.setZero();
  scene.work_space.size = Vector3d::Constant(kRoom);
  scene.work_space.restitution = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    SceneObject& ball = scene.objects.emplace_back();
    ball.name = "ball " + std::to_string(i);
    ball.shape = SphereShape{kRadius};
    ball.pose.position = 0.45 * kRoom * Vector3d(any(random), any(random), any(random));
    ball.matter = {0.02, 0.0, 1.0};
  }
  return scene;
}

/// A hand that rests, and dashes off now and then.
class Wanderer {
 public:
  HandReach move(double dt, std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    if (any(random) > 0.98) velocity_ = 5.0 * Vector3d(any(random), any(random), any(random));
    if (any(random) > 0.9) velocity_.setZero();
    at_ = (at_ + dt * velocity_).cwiseMin(0.5 * kRoom).cwiseMax(-0.5 * kRoom);
    return {at_, 0.002, velocity_.norm()};
  }

 private:
  Vector3d at_ = Vector3d::Zero(), velocity_ = Vector3d::Zero();
};

bool may_meet(const BodyState& body, const HandReach& hand) {
  const double gap = (body.position - hand.middle).norm() - kRadius - hand.radius;
  return gap <= kSoon * kPeriod * (hand.speed + body.velocity.norm());
}

TEST(NearBodies, ListAllReachableBodiesDespiteLateSteps) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const std::size_t scenes = test::tries<std::size_t>(8, 20);
  std::size_t met = 0, listed = 0, steps = 0;
  for (std::size_t scene_number = 0; scene_number < scenes; ++scene_number) {
    const Scene scene = of_bouncing_balls(24, random);
    const EffectPlan plan(scene);
    BodyWorld world(plan, scene.gravity, nullptr, scene.work_space);
    std::array<Wanderer, 2> hands;
    for (std::size_t i = 0; i < hands.size(); ++i) ASSERT_EQ(world.add_hand(), i);
    nanoseconds now{1'000'000'000}, before = now;
    world.advance_to(now);
    for (std::size_t i = 0; i < 24; ++i)
      world.push(i, world.states()[i].position,
                 200.0 * Vector3d(any(random) - 0.5, any(random) - 0.5, any(random) - 0.5));
    for (int step = 0; step < 1500; ++step, ++steps) {
      const double late = any(random) < 0.05 ? 3e6 * any(random) : 1e5 * (any(random) - 0.5);
      before = std::exchange(now, now + nanoseconds(1'000'000 + std::llround(late)));
      const bool is_frozen = any(random) < 0.01;
      for (std::size_t i = 0; i < hands.size(); ++i) {
        world.advance_to(now, is_frozen);
        const double dt = 1e-9 * static_cast<double>((now - before).count());
        const HandReach reach = hands[i].move(dt, random);
        const auto near = world.near(i, reach, kPeriod);
        ASSERT_TRUE(std::ranges::is_sorted(near));
        listed += near.size();
        for (std::uint32_t body = 0; body < world.states().size(); ++body) {
          const BodyState& state = world.states()[body];
          if (!may_meet(state, reach)) continue;
          ++met;
          ASSERT_TRUE(std::ranges::binary_search(near, body)) << "step " << step;
          const ObjectMotion& past = world.state_before(body);
          const double fastest = std::max(state.velocity.norm(), past.velocity.norm());
          ASSERT_LE((state.position - past.position).norm(), fastest * (dt + kAhead) + 1e-12);
        }
        // Another hand pushes a body, which invalidates the prediction.
        if (any(random) < 0.02)
          world.push(step % 24, world.states()[step % 24].position, 50.0 * Vector3d::UnitX());
        world.foresee(i, kPeriod);
        if (any(random) < 0.99) world.written(i, reach);
      }
    }
  }
  EXPECT_GT(met, 250u * scenes);
  EXPECT_LT(listed, steps * 24);  // for both hands: most are far
}

// A body with a force at a distance is always near.
TEST(NearBodies, ListBodiesWithForcesAtADistance) {
  NearBodies near({0.01, std::numeric_limits<double>::infinity()});
  const std::size_t hand = near.add_hand();
  std::array<BodyState, 2> states;
  states[0].position = states[1].position = {5.0, 0.0, 0.0};
  const std::array<std::uint32_t, 2> awake{0, 1};
  const CellGrid asleep;
  const auto found = near.of(
      hand, {Vector3d::Zero(), 0.0, 0.0},
      [&] {
        return BodiesAbout{states, awake, asleep};
      },
      kPeriod);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0], 1u);
}

}  // namespace
}  // namespace reckon::haptics::near_bodies_test
