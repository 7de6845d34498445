// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers ask for bodies, hand them over, and adopt those of failed owners.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "reckon/tests/integration/owners_exercise.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// Every living peer names this one as the owner.
void expect_owner(OwnersExercise& exercise, std::size_t body, std::size_t owner) {
  for (std::size_t i = 0; i < exercise.size(); ++i) {
    if (!exercise.lives(i)) continue;
    EXPECT_EQ(exercise.owner(i, body), exercise.epoch(owner)) << "at " << i;
  }
}

TEST(Ownership, PassesToThePeerThatAsks) {
  OwnersExercise exercise(3, cubes_scene(1));
  exercise.start_all();
  exercise.run(3000);
  EXPECT_TRUE(exercise.simulates(0, 0));
  for (const std::size_t taker : {1u, 2u, 0u}) {
    exercise.owners(taker).acquire(0);
    std::size_t most = 0;
    const auto has_it = [&] {
      most = std::max(most, exercise.simulating(0));
      return exercise.simulates(taker, 0);
    };
    EXPECT_LT(exercise.run_until(has_it, 2000), 50u) << taker;
    EXPECT_LE(most, 1u);
    exercise.run(300);
    exercise.owners(taker).divest(0);
    expect_owner(exercise, 0, taker);
  }
}

TEST(Ownership, WaitsUntilTheOwnerDivests) {
  OwnersExercise exercise(2, cubes_scene(1));
  exercise.start_all();
  exercise.run(3000);
  exercise.owners(0).acquire(0);
  exercise.owners(1).acquire(0);
  exercise.run(3000);
  EXPECT_TRUE(exercise.simulates(0, 0));
  EXPECT_EQ(exercise.owners(0).asker_of(0), (aoim::PeerId{1, 2}));
  exercise.owners(0).divest(0);
  exercise.run(100);
  EXPECT_TRUE(exercise.simulates(1, 0));
}

TEST(Ownership, IsRefusedToWhomTouchDoesNotName) {
  OwnersExercise exercise(3, cubes_scene(1, 0.02, "touch = [\"1:1\", \"1:2\"]"));
  exercise.start_all();
  exercise.run(3000);
  exercise.owners(2).acquire(0);
  exercise.run(3000);
  EXPECT_TRUE(exercise.simulates(0, 0));
  exercise.owners(1).acquire(0);
  exercise.run(100);
  EXPECT_TRUE(exercise.simulates(1, 0));
}

// Three hand-overs a second of a falling, sliding cube: at each peer the shown motion has no jump.
TEST(Ownership, PassesWithoutAJump) {
  for (const auto& law : {line_of(milliseconds(1), {}, 0.0), line_of(milliseconds(30), {}, 0.0),
                          line_of(milliseconds(30), milliseconds(20), 0.1)}) {
    OwnersExercise exercise(3, cubes_scene(1, 0.02));
    exercise.network().impair(law);
    exercise.start_all();
    exercise.run(3000);
    haptics::BodyOrder push{haptics::BodyAct::place, 0};
    push.state.position = {0, 0, 0.1};
    push.state.velocity = {0.3, 0, 5.0};
    push.state.turn_rate = {0, 0, 1.0};
    ASSERT_TRUE(exercise.owners(0).order(push));
    exercise.run(100);
    double jump = 0;
    std::vector<haptics::ObjectMotion> last(3);
    for (std::size_t i = 0; i < 3; ++i) last[i] = exercise.shown(i, 0);
    std::size_t hand_overs = 0;
    for (int t = 0; t < 800; ++t) {
      if (t % 200 == 0) exercise.owners(1 + static_cast<std::size_t>(t / 200) % 2).acquire(0);
      if (t % 200 == 180) exercise.owners(1 + static_cast<std::size_t>(t / 200) % 2).divest(0);
      exercise.step();
      for (std::size_t i = 0; i < 3; ++i) {
        const haptics::ObjectMotion body = exercise.shown(i, 0);
        const Eigen::Vector3d way = body.position - last[i].position;
        // Its speed may have a step, after a lost update.
        jump = std::max(jump, std::min((way - 1e-3 * body.velocity).norm(),
                                       (way - 1e-3 * last[i].velocity).norm()));
        last[i] = body;
      }
      ASSERT_LE(exercise.simulating(0), 1u);
    }
    hand_overs = exercise.count(0, "bodies_granted") + exercise.count(1, "bodies_granted") +
                 exercise.count(2, "bodies_granted");
    EXPECT_GE(hand_overs, 3u);
    EXPECT_LE(jump, 1e-3);
  }
}

TEST(Ownership, OfAKilledPeerIsAdopted) {
  OwnersExercise exercise(3, cubes_scene(4));
  exercise.start_all();
  exercise.run(3000);
  exercise.owners(1).acquire(2);
  exercise.run(500);
  exercise.kill(0);
  std::size_t most = 0;
  const auto is_adopted = [&] {
    bool all = true;
    for (std::size_t body = 0; body < 4; ++body) {
      const std::size_t count = exercise.simulating(body);
      most = std::max(most, count);
      all = all && count == 1;
    }
    return all;
  };
  EXPECT_LT(exercise.run_until(is_adopted, 10'000), 5000u);
  EXPECT_LE(most, 1u);
  exercise.run(500);
  expect_owner(exercise, 2, 1);
  const std::size_t heir = exercise.simulates(1, 0) ? 1 : 2;
  expect_owner(exercise, 0, heir);
  EXPECT_THAT(exercise.notices(heir), Contains(HasSubstr("this peer owns 3 bodies now")));
}

TEST(Ownership, OfTwoTheJuniorIsReplaced) {
  OwnersExercise exercise(2, cubes_scene(2));
  exercise.start_all();
  exercise.run(3000);
  exercise.owners(1).acquire(0);
  exercise.run(500);
  ASSERT_TRUE(exercise.simulates(1, 0));
  exercise.kill(1);
  EXPECT_LT(exercise.run_until([&] { return exercise.simulates(0, 0); }, 10'000), 5000u);
}

TEST(Ownership, OfTwoTheJuniorRests) {
  OwnersExercise exercise(2, cubes_scene(2, 3.0));
  exercise.start_all();
  exercise.run(2000);
  exercise.owners(1).acquire(0);
  exercise.run(500);
  ASSERT_TRUE(exercise.simulates(1, 0));
  exercise.kill(0);
  exercise.run(2900);
  EXPECT_FALSE(exercise.simulates(1, 0));
  EXPECT_THAT(exercise.notices(1), Contains(HasSubstr("bodies rest: 1 of the 2 peers")));
  exercise.run(10'000);
  EXPECT_FALSE(exercise.simulates(1, 1));
  exercise.owners(1).go_alone();
  exercise.run(10);
  EXPECT_TRUE(exercise.simulates(1, 0));
  EXPECT_TRUE(exercise.simulates(1, 1));
}

TEST(Ownership, OfASleeperIsGone) {
  OwnersExercise exercise(3, cubes_scene(2, 0.02));
  exercise.start_all();
  exercise.run(3000);
  exercise.stop(0);
  exercise.run(8000);
  std::size_t most = 0;
  exercise.resume(0);
  for (int i = 0; i < 4000; ++i) {
    exercise.step();
    if (i > 2) most = std::max(most, exercise.simulating(0));
  }
  EXPECT_EQ(most, 1u);
  EXPECT_FALSE(exercise.simulates(0, 0));
  expect_owner(exercise, 0, exercise.simulates(1, 0) ? 1 : 2);
}

TEST(Ownership, OfALeaverIsPassedOn) {
  OwnersExercise exercise(2, cubes_scene(3));
  exercise.start_all();
  exercise.run(3000);
  exercise.owners(0).leave();
  EXPECT_LT(exercise.run_until([&] { return exercise.owners(0).has_left(); }, 3000), 1000u);
  exercise.kill(0);
  exercise.run(200);
  for (std::size_t body = 0; body < 3; ++body) EXPECT_TRUE(exercise.simulates(1, body)) << body;
  EXPECT_THAT(exercise.notices(1), Not(Contains(HasSubstr("bodies rest"))));
}

TEST(Ownership, OfSeparatedPeersMeetsAgain) {
  OwnersExercise exercise(2, cubes_scene(2));
  exercise.start_all();
  exercise.run(3000);
  exercise.network().impair(0, 1, line_of({}, {}, 1.0));
  exercise.network().impair(1, 0, line_of({}, {}, 1.0));
  exercise.run(4000);
  exercise.owners(1).go_alone();
  exercise.run(1000);
  EXPECT_EQ(exercise.simulating(0), 2u) << "each in its own world";
  exercise.network().impair(0, 1, {});
  exercise.network().impair(1, 0, {});
  exercise.run(3000);
  EXPECT_TRUE(exercise.simulates(0, 0));
  EXPECT_FALSE(exercise.simulates(1, 0));
  expect_owner(exercise, 0, 0);
  EXPECT_THAT(exercise.notices(1), Contains(HasSubstr("own the bodies again together")));
}

TEST(Ownership, OfATowerPassesTogether) {
  std::string scene = cubes_scene(6);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string x = std::to_string(0.1 * static_cast<double>(i));
    scene = with(scene, "position = [" + x + ", 0, 0.020000]",
                 "position = [0, 0, " + std::to_string(0.02 + 0.04 * static_cast<double>(i)) + "]");
  }
  OwnersExercise exercise(2, scene);
  exercise.network().impair(line_of(milliseconds(10), milliseconds(5), 0.3));
  exercise.start_all();
  exercise.run(2500);
  haptics::BodyOrder wake{haptics::BodyAct::wake, 2};
  ASSERT_TRUE(exercise.owners(0).order(wake));
  exercise.run(50);
  exercise.owners(1).acquire(2);
  exercise.run_until([&] { return exercise.simulates(1, 2); }, 2000);
  for (std::size_t body = 0; body < 6; ++body) EXPECT_TRUE(exercise.simulates(1, body)) << body;
  exercise.run(2000);
  for (std::size_t body = 0; body < 6; ++body)
    EXPECT_NEAR(exercise.shown(1, body).position.z(), 0.02 + 0.04 * static_cast<double>(body),
                1e-3);
}

// Pressed bodies sleep for single steps. The lower one must stay with the peer whose hand presses
// the upper one, even if another peer requests it.
TEST(Ownership, OfAPressedTowerStays) {
  const std::string scene =
      with(cubes_scene(2), "position = [0.100000, 0, 0.020000]", "position = [0, 0, 0.06]");
  OwnersExercise exercise(2, scene);
  exercise.start_with_hand(0, 1, [](double t) {
    haptics::HandTarget target;
    target.position = {0, 0, 0.12 - 0.05 * std::min(1.0, t)};
    return target;
  });
  exercise.start(1, 2);
  exercise.run(2500);
  exercise.owners(1).acquire(0);
  std::size_t slept = 0;
  for (int t = 0; t < 5000; ++t) {
    exercise.step();
    slept += exercise.body(0, 0).awake ? 0 : 1;
    ASSERT_TRUE(exercise.simulates(0, 0)) << t;
  }
  EXPECT_GT(slept, 0u);
}

TEST(Ownership, OfManyBodiesChangesAtLoss) {
  OwnersExercise exercise(4, cubes_scene(20));
  exercise.network().impair(line_of(milliseconds(5), milliseconds(5), 0.1));
  exercise.start_all();
  exercise.run(3000);
  std::mt19937 random(5);
  std::array<std::size_t, 20> wanted{};
  for (int t = 0; t < 20'000; ++t) {
    if (t % 10 == 0) {
      const std::size_t body = random() % 20, peer = random() % 4;
      exercise.owners(wanted[body]).divest(body);
      wanted[body] = peer;
      exercise.owners(peer).acquire(body);
    }
    exercise.step();
    for (std::size_t body = 0; body < 20; ++body) ASSERT_LE(exercise.simulating(body), 1u);
  }
  exercise.run(3000);
  for (std::size_t body = 0; body < 20; ++body) {
    EXPECT_EQ(exercise.simulating(body), 1u);
    expect_owner(exercise, body, wanted[body]);
  }
  std::uint64_t granted = 0;
  for (std::size_t i = 0; i < 4; ++i) granted += exercise.count(i, "bodies_granted");
  EXPECT_GT(granted, 1000u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(exercise.count(i, "bodies_stale"), 0u) << i;
}

}  // namespace
}  // namespace reckon::test
