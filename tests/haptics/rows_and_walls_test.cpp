// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rows of five and six hands, and a hand pushed against a wall: both ends of each contact feel the
// forces of springs with the rendered stiffness, on a perfect network and on a slow one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "reckon/tests/haptics/support/hands_in_a_row.hpp"
#include "reckon/tests/support/climb.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::rows_and_walls_test {
namespace {

constexpr double kRight = 0.05;  // of the force

using test::any_choice;
using test::Choice;
using test::climb;
using test::within;

// RECKON_SOAK=1 draws two hundred.
int tried() { return test::tries(8, 200); }

// A push, and its result.
struct Pushed {
  double off = 0;     // relative error of the worst hand against springs
  double beyond = 0;  // the same relative to the limit: kRight of the force, or twice the least
                      // error that is sent
  double least = 0;   // [J]
  std::string scene;
  bool weak = false;  // rendered with less than the device's stiffness

  // A hand is between two others, each of which may have an error of the line's threshold.
  void note(double felt, double right, const RowLine& line) {
    const double error = std::abs(felt - right);
    off = std::max(off, error / right);
    beyond = std::max(beyond, error / std::max(kRight * right, 2 * line.threshold_n));
  }
};

Pushed push_a_row(const Choice<5>& c, unsigned seed) {
  RowHands hands;
  hands.count = 4 + static_cast<std::size_t>(3.999 * c[0]);
  const double press = within(c[1], 0.02, 0.04), rise = within(c[2], 0.5, 3);
  hands.target = [=](std::size_t i, double t) {
    return i == 0 ? press * smooth((t - 0.5) / rise) : 0.0;
  };
  RowLine line;
  line.delay = std::array{0.0, 0.0003, 0.002, 0.005, 0.02, 0.05}[static_cast<int>(5.999 * c[3])];
  HandsInARow row(hands, line, seed);
  while (row.time() < 0.5 + rise + 9) row.step();
  const auto right = row_truth(hands.count, hands.grip, hands.stiffness, press);
  Pushed pushed;
  for (std::size_t i = 0; i < hands.count; ++i) pushed.note(row.felt(i), right[i], line);
  pushed.least = row.least_unlent();
  pushed.scene = std::to_string(hands.count) + " hands, " + std::to_string(1e3 * press) +
                 " mm in " + std::to_string(rise) + " s, " + std::to_string(1e3 * line.delay) +
                 " ms";
  return pushed;
}

// A row is correct three seconds after the press, also on a perfect network: no wave runs along it
// and uses up its energy.
TEST(RowsAndWalls, RowsAreCorrectThreeSecondsAfterAPress) {
  double worst = 0;
  test::Thinned thinned(5);
  for (const std::size_t count : {3u, 4u, 5u, 6u, 7u, 8u}) {
    for (const double stiffness : {300.0, 450.0, 600.0, 800.0}) {
      for (const double rise : {0.5, 1.2}) {
        for (const double delay : {0.0, 0.0005, 0.003}) {
          if (thinned.skips()) continue;
          RowHands hands;
          hands.count = count;
          hands.stiffness = stiffness;
          const double press = count % 2 == 0 ? 0.03 : 0.02;
          hands.target = [=](std::size_t i, double t) {
            return i == 0 ? press * smooth((t - 0.5) / rise) : 0.0;
          };
          RowLine line;
          line.delay = delay;
          HandsInARow row(hands, line, 1);
          while (row.time() < 0.5 + rise + 3) row.step();
          const auto right = row_truth(count, hands.grip, stiffness, press);
          for (std::size_t i = 0; i < count; ++i) {
            // An error below the threshold of an update stays unknown.
            const double bar = std::max(0.03 * right[i], line.threshold_n / 3);
            const double error = std::abs(row.felt(i) - right[i]);
            worst = std::max(worst, error / bar);
            EXPECT_LE(error, bar) << "hand " << i << " of " << count << ", " << stiffness
                                  << " N/m in " << rise << " s, " << delay << " s: " << right[i];
          }
          EXPECT_GE(row.least_unlent(), -1e-9);
        }
      }
    }
  }
  std::printf("rows after 3 s: off by %.2f of the bar at most\n", worst);
}

// Grip, spring between the hands, wall and the second grip in parallel.
Pushed push_at_a_wall(const Choice<5>& c, unsigned seed) {
  RowHands hands;
  hands.stiffness = within(c[0], 300, 900);
  const double wall = within(c[1], 300, 1425), press = within(c[2], 0.01, 0.025);
  hands.target = [=](std::size_t i, double t) { return i == 0 ? press * smooth(t - 0.5) : 0.0; };
  SceneObject object;
  object.name = "wall";
  object.shape = PlaneShape{-Eigen::Vector3d::UnitX()};
  object.pose.position.x() = 2 * hands.radius + 1e-6;  // position of the second hand
  object.effects.of<SpringDamper>().stiffness = wall;
  hands.scene.objects.push_back(object);
  RowLine line;
  line.delay = std::array{0.0, 0.0003, 0.005, 0.02, 0.05}[static_cast<int>(4.999 * c[3])];
  HandsInARow row(hands, line, seed);
  while (row.time() < 6) row.step();
  const double shown = row.shown_stiffness(0);
  const double series = 1 / (1 / shown + 1 / (hands.grip + wall));
  const double right = hands.grip * press * series / (hands.grip + series);
  Pushed pushed;
  for (const std::size_t i : {0u, 1u}) pushed.note(row.felt(i), right, line);
  pushed.least = row.least_unlent();
  pushed.weak = shown < std::min(hands.stiffness, 1900 - wall) * 0.99;
  pushed.scene = "wall " + std::to_string(wall) + " N/m, between " +
                 std::to_string(hands.stiffness) + " N/m, " + std::to_string(1e3 * press) +
                 " mm, " + std::to_string(1e3 * line.delay) + " ms";
  return pushed;
}

using Push = Pushed (*)(const Choice<5>&, unsigned seed);

void try_seeds(Push push) {
  double worst = 0;
  for (int seed = 1; seed <= tried(); ++seed) {
    std::mt19937_64 random(static_cast<unsigned>(seed));
    const Pushed pushed = push(any_choice<5>(random), static_cast<unsigned>(seed));
    EXPECT_LE(pushed.off, kRight) << "seed " << seed << ", " << pushed.scene;
    EXPECT_FALSE(pushed.weak) << "what the device can show; seed " << seed;
    EXPECT_GE(pushed.least, -1e-9) << seed;
    worst = std::max(worst, pushed.off);
  }
  std::printf("%d tried: off by %.3f at most\n", tried(), worst);
}

void climb_to_the_worst(Push push) {
  const auto drawn = [&](const Choice<5>& c) { return push(c, static_cast<unsigned>(1e6 * c[4])); };
  const auto climbed = climb<5>([&](const Choice<5>& c) { return drawn(c).beyond; });
  const Pushed worst = drawn(climbed.worst);
  EXPECT_LE(climbed.badness, 1.0) << worst.scene << ", climb " << climbed.seed;
  EXPECT_GE(worst.least, -1e-9) << worst.scene;
  std::printf("%zu tries, worst %.3f of the bar: %s\n", climbed.tries, climbed.badness,
              worst.scene.c_str());
}

TEST(RowsAndWalls, ManyHandsFeelSpringsInARow) { try_seeds(push_a_row); }
TEST(RowsAndWalls, HandAtAWallFeelsThePushersForce) { try_seeds(push_at_a_wall); }
TEST(RowsAndWalls, NoClimbFindsAnIncorrectRow) { climb_to_the_worst(push_a_row); }
TEST(RowsAndWalls, NoClimbFindsAnIncorrectWall) { climb_to_the_worst(push_at_a_wall); }

}  // namespace
}  // namespace reckon::haptics::rows_and_walls_test
