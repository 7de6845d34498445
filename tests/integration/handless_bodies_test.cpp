// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A first peer without a device moves the bodies of its scene, and other peers see and feel them.
#include <gtest/gtest.h>

#include "reckon/tests/integration/owners_exercise.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::test {
namespace {

/// A first peer without a device, a second with a hand that comes to the fallen cube after 2.2 s, and
/// a third without one.
class Handless : public OwnersExercise {
 public:
  Handless() : OwnersExercise(3, cubes_scene(1, 0.3)) {
    start(0, 1);
    start_with_hand(1, 2, [](double t) {
      haptics::HandTarget target;
      target.position = {t < 2.2 ? 0.15 : 0.0, 0, 0.01};
      return target;
    });
    start(2, 3);
  }
};

TEST(HandlessPeer, MovesTheBodiesOfItsScene) {
  Handless exercise;
  EXPECT_EQ(exercise.body(0, 0).position.z(), 0.3);
  exercise.run(100);
  EXPECT_EQ(exercise.peer(0).next_step(), exercise.now() + milliseconds(1));
  exercise.run(1900);
  EXPECT_NEAR(exercise.body(0, 0).position.z(), 0.02, 1e-4) << "it fell";
  EXPECT_TRUE(exercise.simulates(0, 0));
  EXPECT_LT((exercise.body(1, 0).position - exercise.body(0, 0).position).norm(), 1e-4);
  EXPECT_EQ(exercise.simulating(0), 1u);
  exercise.run(1500);
  int soon = 0;
  for (int i = 0; i < 100; ++i) {
    exercise.step();
    soon += exercise.peer(0).next_step() <= exercise.now() + milliseconds(1) ? 1 : 0;
  }
  EXPECT_LT(soon, 10) << "it sleeps";
  EXPECT_TRUE(exercise.simulates(1, 0)) << "the hand of the second peer came to it";
  EXPECT_LT(exercise.body(1, 0).position.x(), -0.01) << "and pushed it";
}

TEST(HandlessPeer, CostsNoAllocation) {
  Handless exercise;
  exercise.run(2700);  // both peers have owned it
  const AllocationGuard guard;
  exercise.run(1000);
  EXPECT_EQ(guard.count(), 0u);
}

// The second peer, with a hand, goes on with the fall where the first one was.
TEST(HandlessPeer, HandsAFallingBodyOver) {
  Handless exercise;
  exercise.run(2000);
  haptics::BodyOrder place{haptics::BodyAct::place, 0};
  place.state.position = {0, 0.2, 1.0};
  ASSERT_TRUE(exercise.owners(0).order(place));
  exercise.run(150);
  exercise.owners(1).acquire(0);
  const double steps =
      static_cast<double>(exercise.run_until([&] { return exercise.simulates(1, 0); }, 100));
  EXPECT_LT(steps, 20);
  EXPECT_FALSE(exercise.simulates(0, 0));
  const double fallen = 0.5 * 9.81 * 0.001 * 0.001 * (150 + steps) * (150 + steps);
  EXPECT_NEAR(exercise.body(1, 0).position.z(), 1.0 - fallen, 0.01);
  exercise.run(50);
  EXPECT_NEAR(exercise.shown(0, 0).position.z(), exercise.body(1, 0).position.z(), 0.003);
}

}  // namespace
}  // namespace reckon::test
