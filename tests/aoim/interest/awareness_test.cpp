// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/awareness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace reckon::aoim::awareness_test {
namespace {

using Shape = AwarenessFocus::Shape;
constexpr double kPi = std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Boxes = std::vector<Occluders::Box>;

Observer ball(const Position& position, double radius) {
  Observer observer;
  observer.focus.position = position;
  observer.focus.radius = radius;
  return observer;
}

Subject at(const Position& position, double nimbus = 0.0) {
  Subject subject;
  subject.position = position;
  subject.nimbus = nimbus;
  return subject;
}

TEST(AwarenessFocus, DistanceToAConeMatchesBruteForce) {
  // The cone is along z, so its points have two coordinates: brute force over both.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> along(-2.0, 2.0), wide(0.05, kPi);
  constexpr int kSteps = 400;
  for (int i = 0; i < 40; ++i) {
    AwarenessFocus focus;
    focus.shape = Shape::cone;
    focus.axis = {0, 0, 1};
    focus.half_angle = wide(random);
    focus.radius = 1.0;
    const double across = std::abs(along(random)), up = along(random), turn = along(random);
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a <= kSteps; ++a) {
      const double angle = focus.half_angle * a / kSteps;
      for (int r = 0; r <= kSteps; ++r) {
        const double x = std::sin(angle) * r / kSteps - across;
        const double z = std::cos(angle) * r / kSteps - up;
        least = std::min(least, x * x + z * z);
      }
    }
    const double exact = distance_to(focus, {across * std::cos(turn), across * std::sin(turn), up});
    // The tolerance is half the diagonal of a sample step.
    EXPECT_LE(exact, std::sqrt(least) + 1e-12);
    EXPECT_NEAR(exact, std::sqrt(least), 0.5 * std::hypot(1.0, focus.half_angle) / kSteps + 1e-12);
  }
}

TEST(AwarenessFocus, ConeDegeneratesToABallOrALine) {
  AwarenessFocus focus;
  focus.shape = Shape::cone;
  focus.radius = 2.0;
  focus.half_angle = kPi;
  EXPECT_DOUBLE_EQ(distance_to(focus, {-3, 0, 0}), 1.0);
  EXPECT_EQ(distance_to(focus, {-1, 1, 0}), 0.0);
  focus.half_angle = 0.0;
  EXPECT_DOUBLE_EQ(distance_to(focus, {1, 1, 0}), 1.0);
  EXPECT_DOUBLE_EQ(distance_to(focus, {5, 4, 0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to(focus, {-3, 0, 4}), 5.0);
}

TEST(AwarenessFocus, MeasuresDistanceToNearestPointOfABox) {
  AwarenessFocus focus;
  focus.shape = Shape::box;
  focus.position = {10, 0, 0};
  focus.half_sides = {1, 2, 3};
  EXPECT_EQ(distance_to(focus, {10.5, -1.5, 2.9}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(focus, {14, 0, 7}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to(focus, {8, -4, 5}), 3.0);
}

TEST(Awareness, NimbusExtendsIntoTheFocus) {
  AwarenessEvaluator evaluator;
  const Observer observer = ball({0, 0, 0}, 10.0);
  EXPECT_EQ(evaluator.evaluate(observer, at({12, 0, 0})), Awareness::out_of_focus);
  EXPECT_EQ(evaluator.evaluate(observer, at({12, 0, 0}, 2.0)), Awareness::aware);
}

TEST(Awareness, IsNotMutual) {
  AwarenessEvaluator evaluator;
  Observer looks_away = ball({0, 0, 0}, 100.0), looks_here = ball({10, 0, 0}, 100.0);
  for (Observer* one : {&looks_away, &looks_here}) {
    one->focus.shape = Shape::cone;
    one->focus.half_angle = 0.5;
    one->focus.axis = {-1, 0, 0};
  }
  EXPECT_EQ(evaluator.evaluate(looks_here, at(looks_away.focus.position)), Awareness::aware);
  EXPECT_EQ(evaluator.evaluate(looks_away, at(looks_here.focus.position)), Awareness::out_of_focus);
}

TEST(Awareness, EvaluatesCheapTestsFirstAndCountsEach) {
  const Occluders wall(Boxes{{{4, -1, -1}, {5, 1, 1}}});
  AwarenessEvaluator evaluator(&wall);
  Observer observer = ball({0, 0, 0}, 20.0);
  observer.kinds = 0b10;
  observer.roles = 0b100;
  observer.aura = 30.0;
  Subject subject = at({9, 0, 0});
  subject.kind = 2;
  subject.roles = 0b011;
  subject.aura = 5.0;
  subject.position.x = kNan;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::not_finite);
  subject.position.x = 40.0;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::class_off);
  subject.kind = 1;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::class_off);
  subject.roles = 0b110;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::auras_apart);
  subject.position.x = 34.0;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::out_of_focus);
  subject.nimbus = 14.0;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::occluded);
  subject.position.y = 20.0;
  subject.nimbus = 30.0;
  subject.position.x = 9.0;
  EXPECT_EQ(evaluator.evaluate(observer, subject), Awareness::aware);
  EXPECT_EQ(evaluator.count(Awareness::class_off), 2u);
  for (const auto once : {Awareness::aware, Awareness::not_finite, Awareness::auras_apart,
                          Awareness::out_of_focus, Awareness::occluded}) {
    EXPECT_EQ(evaluator.count(once), 1u);
  }
}

TEST(Occluders, HidePointsBehindASampledBox) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> where(-3.0, 3.0), side(0.2, 1.5);
  int hidden = 0;
  for (int i = 0; i < 3000; ++i) {
    const Position lower{where(random), where(random), where(random)};
    const Occluders::Box box{
        lower, {lower.x + side(random), lower.y + side(random), lower.z + side(random)}};
    const Position from{where(random), where(random), where(random)};
    const Position to{where(random), where(random), where(random)};
    const auto depth = [&](double t) {
      const Position p{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                       from.z + t * (to.z - from.z)};
      return std::min({p.x - box.lower.x, box.upper.x - p.x, p.y - box.lower.y, box.upper.y - p.y,
                       p.z - box.lower.z, box.upper.z - p.z});
    };
    double deepest = -1e9;
    for (int k = 0; k <= 2000; ++k) deepest = std::max(deepest, depth(k / 2000.0));
    const bool one_inside = depth(0.0) > 0 || depth(1.0) > 0;
    const bool hides = Occluders(Boxes{box}).hides(from, to);
    hidden += hides ? 1 : 0;
    if (one_inside) {
      EXPECT_FALSE(hides);
    }
    if (!one_inside && deepest > 0) {
      EXPECT_TRUE(hides);
    }
    // A line of at most 11 m with 2,000 samples misses at most a corner of 6 mm.
    if (deepest < -0.006) {
      EXPECT_FALSE(hides);
    }
  }
  EXPECT_GT(hidden, 50);
}

TEST(Occluders, DoNotHideInsideOrOnTheSurface) {
  const Occluders house(Boxes{{{0, 0, 0}, {10, 10, 10}}});
  EXPECT_TRUE(house.hides({-1, 5, 5}, {11, 5, 5}));
  EXPECT_FALSE(house.hides({-1, 5, 5}, {5, 5, 5}));
  EXPECT_FALSE(house.hides({5, 5, 5}, {11, 5, 5}));
  EXPECT_FALSE(house.hides({-1, 5, 5}, {0, 5, 5}));
  EXPECT_FALSE(house.hides({-1, 0, 5}, {11, 0, 5}));
  EXPECT_FALSE(house.hides({-1, 5, 5}, {-1, 5, 5}));
}

TEST(Occluders, RefuseABoxThatIsNone) {
  EXPECT_THROW(Occluders(Boxes{{{0, 0, 0}, {1, 0, 1}}}), std::invalid_argument);
  EXPECT_THROW(Occluders(Boxes{{{0, 0, kNan}, {1, 1, 1}}}), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::aoim::awareness_test
