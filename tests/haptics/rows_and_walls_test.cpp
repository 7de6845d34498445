// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rows of five and six hands, and a hand pushed against a wall: both ends of each contact feel what
// springs as stiff as the devices show them would give, on a perfect network as on a slow one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "reckon/tests/haptics/support/hands_in_a_row.hpp"

namespace reckon::haptics {
namespace {

constexpr double kRight = 0.05;  // of the force

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// RECKON_SOAK=1 draws two hundred.
int tried() { return std::getenv("RECKON_SOAK") != nullptr ? 200 : 8; }

TEST(RowsAndWalls, ManyHandsInARowFeelSpringsInARow) {
  double worst = 0;
  for (int seed = 1; seed <= tried(); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    RowHands hands;
    hands.count = 4 + random() % 4;
    const double press = between(random, 0.02, 0.04), rise = between(random, 0.5, 3);
    hands.target = [=](std::size_t i, double t) {
      return i == 0 ? press * smooth((t - 0.5) / rise) : 0.0;
    };
    RowLine line;
    line.delay = std::array{0.0, 0.0003, 0.002, 0.005, 0.02, 0.05}[random() % 6];
    HandsInARow row(hands, line, static_cast<unsigned>(seed));
    while (row.time() < 0.5 + rise + 9) row.step();
    const auto right = row_truth(hands.count, hands.grip, hands.stiffness, press);
    for (std::size_t i = 0; i < hands.count; ++i) {
      const double off = std::abs(row.felt(i) - right[i]) / right[i];
      worst = std::max(worst, off);
      EXPECT_LE(off, kRight) << "seed " << seed << ", hand " << i + 1 << " of " << hands.count
                             << ", " << 1e3 * press << " mm in " << rise << " s, "
                             << 1e3 * line.delay << " ms";
    }
    EXPECT_GE(row.least_unlent(), -1e-9) << seed;
  }
  std::printf("%d rows: off by %.3f at most\n", tried(), worst);
}

// Grip, spring between the hands, wall and the second grip side by side.
TEST(RowsAndWalls, AHandPushedAgainstAWallFeelsWhatThePusherFeels) {
  double worst = 0;
  for (int seed = 1; seed <= tried(); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    RowHands hands;
    hands.stiffness = between(random, 300, 900);
    const double wall = between(random, 300, 1425), press = between(random, 0.01, 0.025);
    hands.target = [=](std::size_t i, double t) { return i == 0 ? press * smooth(t - 0.5) : 0.0; };
    SceneObject object;
    object.name = "wall";
    object.shape = PlaneShape{-Eigen::Vector3d::UnitX()};
    object.pose.position.x() = 2 * hands.radius + 1e-6;  // where the second hand is
    object.effects.of<SpringDamper>().stiffness = wall;
    hands.scene.objects.push_back(object);
    RowLine line;
    line.delay = std::array{0.0, 0.0003, 0.005, 0.02, 0.05}[random() % 5];
    HandsInARow row(hands, line, static_cast<unsigned>(seed));
    while (row.time() < 6) row.step();
    const double shown = row.shown_stiffness(0);
    const double series = 1 / (1 / shown + 1 / (hands.grip + wall));
    const double right = hands.grip * press * series / (hands.grip + series);
    for (const std::size_t i : {0u, 1u}) {
      const double off = std::abs(row.felt(i) - right) / right;
      worst = std::max(worst, off);
      EXPECT_LE(off, kRight) << "seed " << seed << ", hand " << i + 1 << ", wall " << wall
                             << " N/m, between " << hands.stiffness << " N/m";
    }
    EXPECT_GE(shown, std::min(hands.stiffness, 1900 - wall) * 0.99) << "what the device can show";
    EXPECT_GE(row.least_unlent(), -1e-9) << seed;
  }
  std::printf("%d walls: off by %.3f at most\n", tried(), worst);
}

}  // namespace
}  // namespace reckon::haptics
