// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/hybrid_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <stdexcept>

#include "reckon/tests/bench/linear_systems/random_systems.hpp"

namespace reckon::bench {
namespace {

TEST(HybridMotion, PlantIsItsClosedFormToTwelveDigits) {
  test::Random random(16);
  for (int i = 0; i < 10'000; ++i) {
    const MassDamper body{std::pow(10, test::uniform(random, -2, 1)),
                          std::pow(10, test::uniform(random, -2, 2))};
    const MotionState s{test::uniform(random, -1, 1), test::uniform(random, -1, 1)};
    const double f = test::uniform(random, -5, 5), t = std::pow(10, test::uniform(random, -4, 0.5));
    // In long double and by the textbook formula.
    const long double r = static_cast<long double>(body.damping) / body.mass,
                      end = f / static_cast<long double>(body.damping);
    const long double decay = -std::expm1(-r * t);
    const long double v = s.velocity + (end - s.velocity) * decay;
    const long double x = s.position + end * t + (s.velocity - end) * decay / r;
    const MotionState after = advanced(body, s, f, t);
    const double scale = 1 + std::abs(f) * t / body.mass * (1 + t);
    EXPECT_NEAR(after.velocity, static_cast<double>(v), 1e-12 * scale);
    EXPECT_NEAR(after.position, static_cast<double>(x), 1e-12 * scale);
  }
}

TEST(HybridMotion, PlantWithNegligibleDampingIsTheParabola) {
  for (const double b : {0.0, 1e-300, 1e-14}) {
    const MotionState after = advanced({2.0, b}, {1.0, -3.0}, 4.0, 0.5);
    EXPECT_NEAR(after.velocity, -3 + 2 * 0.5, 1e-13);
    EXPECT_NEAR(after.position, 1 - 1.5 + 0.25, 1e-13);
  }
}

TEST(HybridMotion, StepsOfAnyLengthGiveTheSameMotion) {
  const MassDamper body{0.1, 0.7};
  MotionState s{0.2, -1.0};
  for (int i = 0; i < 1000; ++i) s = advanced(body, s, 2.0, 1e-3);
  const MotionState whole = advanced(body, {0.2, -1.0}, 2.0, 1.0);
  EXPECT_NEAR(s.position, whole.position, 1e-12);
  EXPECT_NEAR(s.velocity, whole.velocity, 1e-12);
}

TEST(HybridMotion, ContactIsFoundAtItsInstant) {
  EXPECT_NEAR(*first_contact({1, 0}, {2.0, 0.0}, -9.81, 0.0, 10), std::sqrt(2 * 2.0 / 9.81), 1e-15);
  // Thrown upwards first.
  EXPECT_NEAR(*first_contact({1, 0}, {0.0, 3.0}, -9.81, 0.0, 10), 2 * 3.0 / 9.81, 1e-15);
  // Too slow to reach it: pushed back, braked by the damper, or beyond the horizon.
  EXPECT_FALSE(first_contact({1, 0}, {1.0, -1.0}, 1.0, 0.0, 10));
  EXPECT_FALSE(first_contact({1, 1}, {1.0, -0.99}, 0.0, 0.0, 100));
  EXPECT_TRUE(first_contact({1, 1}, {1.0, -1.01}, 0.0, 0.0, 100));
  EXPECT_FALSE(first_contact({1, 0}, {2.0, 0.0}, -9.81, 0.0, 0.5));
  EXPECT_FALSE(first_contact({1, 0}, {0.0, 1.0}, 1.0, 0.0, 10));
  EXPECT_EQ(*first_contact({1, 0}, {0.0, 0.0}, -1.0, 0.0, 10), 0.0);
  // It grazes: a hundredth of a micrometre deep; the horizon contains both sides of the deepest
  // point.
  const double speed = std::sqrt(2.0 * (1.0 + 1e-8));
  const double graze = *first_contact({1, 0}, {1.0, -speed}, 1.0, 0.0, 100);
  EXPECT_NEAR(advanced({1, 0}, {1.0, -speed}, 1.0, graze).position, 0, 1e-14);
  EXPECT_LT(graze, speed);
}

TEST(HybridMotion, LosslessBallKeepsItsEnergy) {
  const double m = 0.3, g = 9.81, h = 0.7;
  HybridMotion ball({m, 0.0}, {h, 0.0}, RigidStop{});
  for (int i = 0; i < 100'000; ++i) ASSERT_TRUE(ball.run_to_impact(-m * g, 10.0));
  const MotionState& s = ball.state();
  const double energy = 0.5 * m * s.velocity * s.velocity + m * g * s.position;
  EXPECT_LT(std::abs(energy / (m * g * h) - 1), 1e-9);
  EXPECT_NEAR(ball.time() / ((2 * 100'000 - 1) * std::sqrt(2 * h / g)), 1.0, 1e-9);
  std::cout << "energy drift " << energy / (m * g * h) - 1 << "\n";
}

TEST(HybridMotion, BouncesAreIndependentOfTheSteps) {
  HybridMotion whole({1, 0.2}, {1.0, 0.0}, RigidStop{0.0, 0.9});
  HybridMotion parts({1, 0.2}, {1.0, 0.0}, RigidStop{0.0, 0.9});
  whole.run(-9.81, 3.0);
  for (int i = 0; i < 3000; ++i) parts.run(-9.81, 1e-3);
  EXPECT_EQ(whole.impacts(), parts.impacts());
  EXPECT_GT(whole.impacts(), 3);
  EXPECT_NEAR(whole.state().position, parts.state().position, 1e-10);
  EXPECT_NEAR(whole.state().velocity, parts.state().velocity, 1e-9);
}

TEST(HybridMotion, LossyBallRestsAtTheSeriesLimit) {
  const double e = 0.5, g = 9.81, h = 1.0;
  HybridMotion ball({2, 0.0}, {h, 0.0}, RigidStop{0.0, e});
  double last = 0.0;
  while (ball.run_to_impact(-2 * g, 10.0)) last = ball.time();
  EXPECT_NEAR(last, std::sqrt(2 * h / g) * (1 + e) / (1 - e), 1e-8);
  EXPECT_NEAR(ball.lost_in_impacts(), 2 * g * h, 1e-12);
  ball.run(-2 * g, 5.0);
  EXPECT_EQ(ball.state().position, 0.0);
  EXPECT_EQ(ball.state().velocity, 0.0);
  ball.run(1.0, 2.0);
  EXPECT_NEAR(ball.state().position, 0.5 * 0.5 * 4, 1e-12) << "it leaves where it is pulled";
}

TEST(HybridMotion, BadNumbersAreRefused) {
  EXPECT_THROW(HybridMotion({0, 0}, {}, {}), std::invalid_argument);
  EXPECT_THROW(HybridMotion({1, -1}, {}, {}), std::invalid_argument);
  EXPECT_THROW(HybridMotion({1, 0}, {-1, 0}, {}), std::invalid_argument);
  EXPECT_THROW(HybridMotion({1, 0}, {NAN, 0}, {}), std::invalid_argument);
  EXPECT_THROW(HybridMotion({1, 0}, {}, {0, 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench
