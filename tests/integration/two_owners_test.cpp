// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two bodies of two owners meet: one peer gets both before.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "reckon/tests/integration/judged_runs.hpp"

namespace reckon::test {
namespace {

/// Two cubes of two peers slide at each other. @return their velocities afterwards [m/s]
std::array<double, 2> hit(const std::array<double, 2>& speeds, std::size_t peers,
                          const peer::ImpairmentLaw& law) {
  const std::string smooth = with(cubes_scene(2), "plane = [0, 0, 1]",
                                  "plane = [0, 0, 1]\nbody_friction = 0.0\nrestitution = 0.0");
  OwnersExercise exercise(peers, smooth);
  exercise.network().impair(law);
  exercise.start_all();
  exercise.run(3000);
  if (peers > 1) {
    exercise.owners(1).acquire(1);
    EXPECT_LT(exercise.run_until([&] { return exercise.simulates(1, 1); }, 3000), 3000u);
    exercise.run(500);
    exercise.owners(1).divest(1);
  }
  for (std::uint32_t i = 0; i < 2; ++i) {
    haptics::BodyOrder order{haptics::BodyAct::place, i};
    order.state.position = {i == 0 ? -speeds[0] : speeds[1], 0, 0.02};
    order.state.velocity = {i == 0 ? speeds[0] : -speeds[1], 0, 0};
    EXPECT_TRUE(exercise.owners(peers > 1 ? i : 0).order(order));
  }
  exercise.run(1500);
  std::array<double, 2> out{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t owner = peers > 1 && exercise.simulates(1, i) ? 1 : 0;
    out[i] = exercise.body(owner, i).velocity.x();
  }
  return out;
}

// One peer gets both bodies before they meet.
TEST(TouchedBodies, OfTwoOwnersMeetAtOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0.2, 1.0);
  int wrong = 0;
  const int hits = tries(12, 400);
  for (int i = 0; i < hits; ++i) {
    const std::array speeds{any(random), any(random)};
    const auto delay = milliseconds(std::array{1, 20, 50, 100}[static_cast<std::size_t>(i) % 4]);
    const auto truth = hit(speeds, 1, {});
    const auto found = hit(speeds, 2, line_of(delay, delay / 5, i % 8 < 4 ? 0.0 : 0.3));
    const double most = 0.01 * (speeds[0] + speeds[1]);
    EXPECT_LT(found[0], found[1] + most) << "passed through: " << i;
    if (std::abs(found[0] - truth[0]) > most || std::abs(found[1] - truth[1]) > most) ++wrong;
  }
  EXPECT_LE(wrong, hits / 100);
}

/// Each hand holds a cube of its own peer. They bring the cubes together and press them.
OneBody two_holders(double time) {
  OneBody cubes;
  cubes.mass = 0.2;
  cubes.side = 0.04;
  cubes.beside = 0.12;
  cubes.drag = 1.0;
  cubes.grab = 200;
  cubes.seconds = time;
  const auto law = [](double side) {
    return [side](double t) {
      const double out = 0.14 - 0.065 * eased(t, 0.2, 1.2) - 0.055 * eased(t, 2, 3.5);
      haptics::HandTarget target = target_at(0.06 + side * out);
      target.buttons = t > 0.6 ? 1 : 0;
      return target;
    };
  };
  cubes.laws = {law(-1), law(1)};
  return cubes;
}

TEST(TouchedBodies, ArePressedTogetherByTwoHolders) {
  const OneBody cubes = two_holders(7.0);
  const OneBodyRun truth(cubes);
  Share share;
  for (const double delay : {0.0003, 0.02, 0.05}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(cubes, {delay, 0.0, static_cast<std::uint64_t>(seed)});
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      share.note(run.steady_error(truth) <= 0.05 && run.peak() <= 1.5 * truth.peak(), delay, 0.0,
                 seed);
    }
  }
}

// Stated poses of both cubes may overlap. Copies that follow them must not tire the hands.
TEST(TouchedBodies, KeepPressingForTwentyFiveSeconds) {
  const OneBody cubes = two_holders(25.0);
  const OneBodyRun truth(cubes);
  for (int seed = 1; seed <= tries(2, 20); ++seed) {
    const OneBodyRun run(cubes,
                         {seed % 2 == 0 ? 0.02 : 0.05, 0.0, static_cast<std::uint64_t>(seed)});
    EXPECT_LE(run.steady_error(truth), seed % 2 == 0 ? 0.03 : 0.06) << seed;
  }
}

// Only the second peer has a hand: it holds one cube, and pushes the other by it.
TEST(TouchedBodies, OfTwoOwnersGoToTheHand) {
  OneBody cubes;
  cubes.mass = 0.2;
  cubes.side = 0.04;
  cubes.beside = 0.12;
  cubes.drag = 5.0;
  cubes.grab = 200;
  cubes.seconds = 5.0;
  cubes.laws = {[](double) { return target_at(1.0); },
                [](double t) {
                  haptics::HandTarget target =
                      target_at(0.2 - 0.065 * eased(t, 0.2, 1.2) - 0.05 * std::max(0.0, t - 2));
                  target.buttons = t > 0.6 ? 1 : 0;
                  return target;
                }};
  const OneBodyRun truth(cubes);
  Share share;
  for (const double delay : {0.0003, 0.02, 0.05}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(cubes, {delay, 0.0, static_cast<std::uint64_t>(seed)});
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      const bool is_right = run.steps().back().owner == 1 && run.error(truth) <= 0.05;
      share.note(is_right, delay, 0.0, seed);
      expect_one_owner(run);
    }
  }
}

}  // namespace
}  // namespace reckon::test
