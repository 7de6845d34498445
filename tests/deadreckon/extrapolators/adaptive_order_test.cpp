// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "reckon/deadreckon/extrapolators/extrapolators.hpp"
#include "reckon/tests/deadreckon/support/known_motions.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon::test {
namespace {

using Eigen::Vector3d;

// Straight line, circle, jerky noise: a motion with a changing best order.
MotionSample mixed(double t, Random& random) {
  const double phase = std::fmod(t, 60.0);
  if (phase < 20) return Polynomial{{0, 0, 0}, {10, 0, 0}, {0, 0, 0}}.at(t);
  if (phase < 40) return on_circle(t);
  MotionSample sample = Polynomial{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}.at(t);
  sample.velocity += random.vector(2);  // sent rates are noise, positions are exact
  sample.acceleration += random.vector(20);
  return sample;
}

TEST(AdaptiveOrder, MatchesTheBestFixedOrderOnEverySegment) {
  constexpr double kGap = 0.2;
  for (int segment = 0; segment < 3; ++segment) {
    Random random(7);
    AdaptiveOrder adaptive;
    MotionHistory history;
    double adaptive_square = 0;
    std::array<double, kExtrapolators.size()> fixed_square{};
    for (int i = 0; i < 100; ++i) {
      const double t = 20 * segment + i * kGap;
      if (i > 5) {  // the choice needs some updates
        const Vector3d truth = mixed(t, random).position;
        adaptive_square += (adaptive.predict(kGap).position - truth).squaredNorm();
        for (std::size_t k = 0; k < kExtrapolators.size(); ++k)
          fixed_square[k] +=
              (kExtrapolators[k].predict(history, kGap, {}).position - truth).squaredNorm();
      }
      const MotionSample sample = mixed(t, random);
      adaptive.add(sample);
      history.add(sample);
    }
    const double best = *std::min_element(fixed_square.begin(), fixed_square.end());
    // Rounding alone on the straight line: 1e-20 m^2.
    EXPECT_LE(std::sqrt(adaptive_square), 1.05 * std::sqrt(best) + 1e-10)
        << "segment " << segment << ", chosen " << adaptive.chosen().name;
  }
}

TEST(AdaptiveOrder, ChangesItsChoiceWithTheMotion) {
  AdaptiveOrder adaptive;
  Random random(3);
  for (double t = 20; t < 30; t += 0.2) adaptive.add(mixed(t, random));
  EXPECT_EQ(adaptive.chosen().name, "two_step_3");  // the circle has a jerk
  adaptive.clear();
  for (double t = 40; t < 50; t += 0.2) adaptive.add(mixed(t, random));
  EXPECT_EQ(adaptive.chosen().needs, SentRates::position);
}

TEST(AdaptiveOrder, UsesNoExtrapolatorThatNeedsUnsentRates) {
  AdaptiveSettings settings;
  settings.sent = SentRates::position;
  AdaptiveOrder adaptive(settings);
  for (double t = 0; t < 5; t += 0.2) {
    MotionSample sample = on_circle(t);
    sample.velocity.setZero();
    sample.acceleration.setZero();
    adaptive.add(sample);
    EXPECT_EQ(adaptive.chosen().needs, SentRates::position);
  }
  EXPECT_EQ(adaptive.chosen().name, "position_history");
}

// A sender of DRM 4 with arbitrary intervals between updates, over a motion with steps in its
// rates.
MotionSample rough(double t, Random& random) {
  MotionSample sample;
  sample.time = t;
  sample.position = random.vector(1e3);
  sample.velocity = random.vector(30);
  sample.acceleration = random.vector(300);
  sample.angular_velocity = random.vector(3);
  sample.orientation = random.rotation();
  return sample;
}

Pose told_by(const MotionSample& sample, double tau) {
  MotionHistory history;
  history.add(sample);
  return second_order_one_step(history, tau, {});
}

TEST(AdaptiveOrder, StraysByAtMostTheObservedErrors) {
  double farthest = 0;
  for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    AdaptiveOrder adaptive;
    MotionSample newest = rough(0, random);
    adaptive.add(newest);
    double worst_error = 0, longest = 0;
    for (int i = 0; i < 6; ++i) {
      const double gap = std::pow(10.0, random.real(-3, 1));
      MotionSample next = rough(newest.time + gap, random);
      const Pose told = told_by(newest, gap);
      next.position = told.position + random.vector(std::pow(10.0, random.real(-4, 1)));
      worst_error = std::max(worst_error, (next.position - told.position).norm());
      longest = std::max(longest, gap);
      ASSERT_TRUE(adaptive.add(next, told));
      newest = next;
    }
    for (const double tau : {0.0, 1e-3, 0.02, 0.1, 0.5, 2.0, 8.0, 49.0, 51.0, 1e4, 1e300}) {
      const Pose told = told_by(newest, tau);
      const Pose near = adaptive.predict_near(told, tau);
      ASSERT_TRUE(is_finite(near)) << seed << ' ' << tau;
      const double apart = (near.position - told.position).norm();
      // Rounding of positions of up to 1e300 m.
      const double rounding = 1e-12 * told.position.norm();
      ASSERT_LE(apart, adaptive.stray(tau) + rounding) << seed << ' ' << tau;
      // For any silence: 1.25 x^3, faded from x = 4.5 on, is at most 114.
      ASSERT_LE(apart, 114 * worst_error + rounding) << seed << ' ' << tau;
      if (tau > AdaptiveOrder::kGivenUp * longest) {
        ASSERT_EQ(near.position, told.position) << seed << ' ' << tau;
      }
      if (tau < 1e4) farthest = std::max(farthest, apart / worst_error);
    }
  }
  EXPECT_GT(farthest, 1);  // the bound is not trivial: it does move
  RecordProperty("farthest", std::to_string(farthest));
}

TEST(AdaptiveOrder, FollowsItsChoiceOnAContinuingMotion) {
  AdaptiveOrder adaptive;
  MotionSample newest = on_circle(0);
  adaptive.add(newest);
  for (int i = 1; i < 20; ++i) {
    const MotionSample next = on_circle(0.2 * i);
    adaptive.add(next, told_by(newest, 0.2));
    newest = next;
  }
  // Up to two lost updates and a third in transit.
  for (const double tau : {0.05, 0.2, 0.4, 0.65}) {
    const Pose near = adaptive.predict_near(told_by(newest, tau), tau);
    const Vector3d truth = on_circle(newest.time + tau).position;
    EXPECT_LE((near.position - truth).norm(), 0.4 * (told_by(newest, tau).position - truth).norm())
        << tau;
  }
}

}  // namespace
}  // namespace reckon::deadreckon::test
