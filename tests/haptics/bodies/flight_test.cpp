// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace reckon::haptics::flight_test {
namespace {

TEST(Flight, FallsWithDragAsInTinySteps) {
  for (const double drag : {0.0, 1e-9, 1e-4, 0.02, 1.0, 50.0}) {
    long double place = 0.3, speed = -2.0;
    const long double h = 1e-6L;
    for (int i = 0; i < 500'000; ++i) {
      const long double middle = speed + 0.5L * h * (-9.81L - drag * speed);
      place += h * middle;
      speed += h * (-9.81L - drag * middle);
    }
    Flight now{0.3, -2.0};
    for (int i = 0; i < 50; ++i) now = fly(now, -9.81, drag, 0.01);
    EXPECT_NEAR(now.place, static_cast<double>(place), 1e-9) << drag;
    EXPECT_NEAR(now.speed, static_cast<double>(speed), 1e-9) << drag;
  }
}

// Without gravity only rebounds change the energy: each leaves e^2 of it.
TEST(Flight, ReboundsKeepTheSquareOfTheRestitution) {
  for (const double restitution : {1.0, 0.9, 0.5}) {
    const Walls walls{-0.1, 0.2, restitution};
    Flight now{0.05, 3.0};
    int rebounds = 0;
    double last = now.speed;
    for (int i = 0; i < 20'000 && rebounds < 7; ++i) {
      now = bounce(now, 0.0, walls, 1e-3);
      if (std::signbit(now.speed) != std::signbit(last)) ++rebounds;
      last = now.speed;
      const double right = 9.0 * std::pow(restitution, 2 * rebounds);
      ASSERT_NEAR(now.speed * now.speed / right, 1.0, 1e-9) << rebounds;
    }
    EXPECT_EQ(rebounds, 7);
  }
}

// With gravity: the energy above the floor, after each rebound from it.
TEST(Flight, KeepsItsEnergyBetweenReboundsFromAFloor) {
  const double e = 0.8;
  const Walls walls{0.0, 100.0, e};
  Flight now{1.0, 0.0};
  int rebounds = 0;
  double last = 0.0;
  for (int i = 0; i < 5'000 && rebounds < 8; ++i) {
    now = bounce(now, -9.81, walls, 1e-3);
    if (now.speed > 0 && last < 0) ++rebounds;
    last = now.speed;
    const double energy = 9.81 * now.place + 0.5 * now.speed * now.speed;
    ASSERT_NEAR(energy / (9.81 * std::pow(e, 2 * rebounds)), 1.0, 1e-9) << rebounds;
  }
  EXPECT_EQ(rebounds, 8);
}

TEST(Flight, IsNeverOutsideAtAnySpeed) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 200'000; ++i) {
    const Walls walls{-std::pow(10.0, 3 * any(random) - 3), std::pow(10.0, 3 * any(random) - 3),
                      0.5 + 0.5 * any(random)};
    const double g = 20 * any(random);
    Flight now{any(random), any(random) * std::pow(10.0, 6 * any(random))};
    for (int k = 0; k < 3; ++k) {
      now = bounce(now, g, walls, 1e-3 * (1 + any(random)));
      ASSERT_LE(walls.low, now.place);
      ASSERT_LE(now.place, walls.high);
      ASSERT_TRUE(std::isfinite(now.speed));
    }
  }
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(bounce({0, 1}, 0, {1, -1, 0.5}, 1).place, 0.0) << "no room";
  EXPECT_EQ(bounce({-inf, 1}, 0, {-1, 1, 0.5}, 0).place, -1.0);
}

TEST(Flight, ComesToRestOnAFloor) {
  Flight now{0.1, 0.0};
  for (int i = 0; i < 5'000; ++i) now = bounce(now, -9.81, {0.0, 1.0, 0.5}, 1e-3);
  EXPECT_EQ(now.place, 0.0);
  EXPECT_EQ(now.speed, 0.0);
}

TEST(Flight, IsStoppedByAWall) {
  const Walls walls{-1, 1, 0.5};
  EXPECT_EQ(stop({1.2, 3}, walls).speed, -1.5);
  EXPECT_EQ(stop({1.2, 3}, walls).place, 1.0);
  EXPECT_EQ(stop({1.2, -3}, walls).speed, -3) << "it comes back by itself";
  EXPECT_EQ(stop({0.5, 3}, walls).place, 0.5);
  EXPECT_EQ(stop({0.5, 3}, walls).speed, 3);
}

}  // namespace
}  // namespace reckon::haptics::flight_test
