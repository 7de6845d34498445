// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A bad network for a minute: no energy is made, the servo never waits, and contacts recover after
// outages.
#include <gtest/gtest.h>

#include <array>

#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::test::impaired_run_test {
namespace {

peer::ImpairmentLaw bad_network() {
  peer::ImpairmentLaw law;
  law.delay = milliseconds(200);
  law.jitter = milliseconds(100);
  law.loss = 0.2;
  law.reorder = 0.1;
  law.duplicate = 0.1;
  return law;
}

constexpr double kNoEnergyMade = -1e-9;  // [J], rounding of a minute's sums

// Returns the seconds of hand-to-hand contact.
double run_a_minute(peer::SceneFile scene, std::uint64_t seed) {
  scene.impairment.law = bad_network();
  scene.impairment.seed = seed;
  tools::ExerciseOptions options;
  options.simulated_time = true;
  options.epoch = 1;
  tools::Exercise exercise(scene, options);
  std::array<std::uint64_t, 2> steps{};
  exercise.on_step([&](std::size_t peer, std::size_t, const haptics::ServoSnapshot& step) {
    EXPECT_EQ(step.step, steps[peer]++);
  });
  exercise.run(seconds(60));
  EXPECT_EQ(steps[0], 60'000u);
  EXPECT_EQ(steps[1], 60'000u);
  EXPECT_GE(exercise.measurement().energy_min(), kNoEnergyMade);
  EXPECT_EQ(exercise.measurement().trips(), 0u);
  EXPECT_GT(exercise.total("datagrams_lost"), 0u);
  EXPECT_GT(exercise.total("datagrams_doubled"), 0u);
  EXPECT_GT(exercise.total("datagrams_reordered"), 0u);
  EXPECT_EQ(exercise.total("values_refused"), 0u);
  EXPECT_EQ(exercise.total("models_refused"), 0u);
  EXPECT_EQ(exercise.total("malformed_in"), 0u);
  return exercise.measurement().touching_hands();
}

TEST(BadNetwork, MakesNoEnergyAndNeverHoldsTheServo) {
  for (std::uint64_t seed = 1; seed <= tries(2U, 5U); ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_GT(run_a_minute(scene_of(kTwoHandsOnAWall), seed), 1.0);
  }
}

TEST(BadNetwork, MakesNoEnergyOnTheShippedScene) {
  EXPECT_GT(run_a_minute(shipped_scene(), 1), 1.0);
}

// 10 s without a datagram: both drop the other; afterwards they meet again.
TEST(Outage, HandsSeeEachOtherAgain) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(2);
  peer::ImpairmentLaw law;
  law.outages = {{seconds(5), seconds(10)}};
  world.network().impair(law);
  world.start(0, scene);
  world.start(1, scene);
  world.run(4900);
  EXPECT_EQ(world.view(0).entities, 1u);
  world.run(9900);
  EXPECT_EQ(world.view(0).entities, 0u);
  EXPECT_EQ(world.view(1).entities, 0u);
  EXPECT_GE(world.view(0).servo().step + 52, world.steps());  // it continued; minus one snapshot
  const auto both = [&] { return world.view(0).entities == 1 && world.view(1).entities == 1; };
  const std::size_t until = world.run_until(both, 3000);
  EXPECT_LE(until, 200u + 1100u) << "the next announcement ends it";
  world.run(2000);
  EXPECT_TRUE(world.view(0).rows[0].haptic);
}

// Short outages, below the time-out: no peer is dropped, the contact recovers.
TEST(Outage, ShortOnesDropNobody) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(2);
  peer::ImpairmentLaw law;
  law.outages = {{seconds(2), milliseconds(1800), seconds(4)}};
  world.network().impair(law);
  world.start(0, scene);
  world.start(1, scene);
  world.run(30'000);
  EXPECT_EQ(world.count(0, "timed_out") + world.count(1, "timed_out"), 0u);
  EXPECT_EQ(world.view(0).entities, 1u);
  EXPECT_GE(world.view(0).servo().port_energy_min, kNoEnergyMade);
}

// Random loss of announcements must not remove a live peer for ever.
TEST(Loss, LivePeersArePresentAtTheEnd) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  peer::ImpairmentLaw law;
  law.loss = 0.3;
  const std::uint64_t seeds = tries(4U, 8U);
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    InProcess world(2, seed);
    world.network().impair(law);
    world.start(0, scene);
    world.start(1, scene);
    world.run(1000);
    std::size_t away = 0;  // [50 ms]
    for (int i = 0; i < 1200; ++i) {
      world.run(50);
      away += world.view(0).entities == 0 ? 1 : 0;
    }
    EXPECT_LT(away, 60u) << "away for " << 0.05 * static_cast<double>(away) << " s of 60 s";
    all += away;
  }
  // A peer that is dropped, in one run of five, returns with its next announcement that arrives.
  EXPECT_LT(all, seeds * 24u) << "away for more than 2 % of the time";
}

}  // namespace
}  // namespace reckon::test::impaired_run_test
