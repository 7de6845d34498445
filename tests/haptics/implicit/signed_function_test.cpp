// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/implicit/signed_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/tests/support/implicit_solids.hpp"
#include "reckon/tests/support/random_point.hpp"

namespace reckon::haptics::signed_function_test {
namespace {

using Eigen::Vector3d;
using test::random_point;

double rho(const Vector3d& p) { return std::hypot(p.x(), p.y()); }

// A primitive with its equations: negative inside and 0 on the surface, dimensionless.
struct Subject {
  const char* name;
  Primitive primitive;
  std::function<double(const Vector3d&)> equation;
};

std::vector<Subject> subjects() {
  const auto frustum = [](double base, double top, double half) {
    return [=](const Vector3d& p) {
      const double wall = base + (top - base) * (p.z() + half) / (2.0 * half);
      return std::max((rho(p) - wall) / std::max(base, top), std::abs(p.z()) / half - 1.0);
    };
  };
  return {
      {"half space", HalfSpaceFunction{{0.0, 0.6, 0.8}},
       [](const Vector3d& p) { return (3.0 * p.y() + 4.0 * p.z()) / 0.5; }},
      {"sphere", SphereFunction{0.05},
       [](const Vector3d& p) { return p.squaredNorm() / 0.0025 - 1.0; }},
      {"box", BoxFunction{{0.05, 0.03, 0.04}},
       [](const Vector3d& p) {
         return std::max({std::abs(p.x()) / 0.05, std::abs(p.y()) / 0.03, std::abs(p.z()) / 0.04}) -
                1.0;
       }},
      {"cylinder", CylinderFunction{0.03, 0.04},
       [](const Vector3d& p) { return std::max(rho(p) / 0.03, std::abs(p.z()) / 0.04) - 1.0; }},
      {"cone", ConeFunction{0.04, 0.0, 0.04}, frustum(0.04, 0.0, 0.04)},
      {"frustum", ConeFunction{0.02, 0.04, 0.025}, frustum(0.02, 0.04, 0.025)},
      {"torus", TorusFunction{0.04, 0.015},
       [](const Vector3d& p) {
         const double out = rho(p) - 0.04;
         return (out * out + p.z() * p.z()) / (0.015 * 0.015) - 1.0;
       }},
      {"ellipsoid", EllipsoidFunction{{0.06, 0.04, 0.02}},
       [](const Vector3d& p) {
         return p.cwiseQuotient(Vector3d(0.06, 0.04, 0.02)).squaredNorm() - 1.0;
       }},
  };
}

// f changes by at most the displacement (below), so it is never more than the distance. Its foot
// point is on the surface at just that distance, so it is no less.
TEST(Primitives, AreSignedDistancesByTheirEquations) {
  for (const Subject& subject : subjects()) {
    SCOPED_TRACE(subject.name);
    const SignedFunction f(subject.primitive);
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p = random_point(random, 0.09);
      const SignedSample here = f.sample(p);
      ASSERT_EQ(here.value < 0.0, subject.equation(p) < 0.0) << p.transpose();
      const Vector3d foot = p - here.value * here.gradient;
      ASSERT_NEAR(subject.equation(foot), 0.0, 1e-12) << p.transpose();
      ASSERT_NEAR(here.gradient.norm(), 1.0, 1e-14) << p.transpose();
    }
  }
}

// Central differences of 1 um. Their own error is h^2 f''' / 6 + 1e-17 / h: below 1e-8 on surfaces
// that are 1 mm away from an edge of f.
double gradient_error(const std::function<SignedSample(const Vector3d&)>& sample, const Vector3d& p,
                      bool& smooth) {
  constexpr double kStep = 1e-6;
  const SignedSample here = sample(p);
  Vector3d difference;
  smooth = true;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vector3d away = kStep * Vector3d::Unit(i);
    const SignedSample after = sample(p + away);
    const SignedSample before = sample(p - away);
    difference[i] = (after.value - before.value) / (2.0 * kStep);
    // At an edge of f the gradient itself jumps, or bends by up to 1 per millimetre.
    smooth &= (after.gradient - here.gradient).norm() < 2e-3 &&
              (here.gradient - before.gradient).norm() < 2e-3 &&
              std::abs(after.value - 2.0 * here.value + before.value) < 1e-3 * kStep;
    smooth &= (after.gradient - 2.0 * here.gradient + before.gradient).norm() < 1e-7;
  }
  return (difference - here.gradient).norm();
}

TEST(SignedFunctions, HaveTheGradientOfTheirValue) {
  double worst = 0.0;
  for (const test::NamedSolid& named : test::implicit_solids()) {
    SCOPED_TRACE(named.name);
    std::mt19937 random(4);
    int smooth_ones = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vector3d p = random_point(random, 0.08);
      bool smooth = false;
      const double error =
          gradient_error([&](const Vector3d& x) { return named.solid->sample(x); }, p, smooth);
      if (!smooth) continue;
      ++smooth_ones;
      worst = std::max(worst, error);
      ASSERT_LT(error, 1e-7) << p.transpose();
    }
    EXPECT_GT(smooth_ones, 4800);
  }
  std::printf("gradients: worst error %.2g\n", worst);
}

TEST(SignedFunctions, ChangeByAtMostTheDisplacement) {
  for (const test::NamedSolid& named : test::implicit_solids()) {
    SCOPED_TRACE(named.name);
    std::mt19937 random(5);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p = random_point(random, 0.09);
      const double reach = std::pow(10.0, -(i % 9));
      const Vector3d q = p + random_point(random, 0.1 * reach);
      const double change = std::abs(named.solid->sample(p).value - named.solid->sample(q).value);
      ASSERT_LE(change, (p - q).norm() + 1e-16) << p.transpose() << " to " << q.transpose();
    }
  }
}

TEST(SignedFunctions, EqualTheBooleanOfTheirParts) {
  const auto all = subjects();
  const auto inside = [&](std::size_t i, const Vector3d& p) { return all[i].equation(p) < 0.0; };
  const SignedFunction box(all[2].primitive);
  const SignedFunction torus(all[6].primitive);
  const SignedFunction cone(all[4].primitive);
  const SignedFunction both = subtract(unite(box, torus), cone);
  const SignedFunction common = intersect(box, subtract(torus, cone));
  const SignedFunction rest = subtract(box, subtract(torus, cone));
  std::mt19937 random(6);
  for (int i = 0; i < 20000; ++i) {
    const Vector3d p = random_point(random, 0.06);
    const bool a = inside(2, p);
    const bool b = inside(6, p);
    const bool c = inside(4, p);
    ASSERT_EQ(both.sample(p).value < 0.0, (a || b) && !c);
    ASSERT_EQ(common.sample(p).value < 0.0, a && b && !c);
    ASSERT_EQ(rest.sample(p).value < 0.0, a && !(b && !c));
  }
}

// Two half spaces at a right angle: the fillet meets each at `radius` from the edge, and in the
// middle sqrt(x) + sqrt(y) = sqrt(radius).
TEST(SignedFunctions, RoundAnEdgeByAParabola) {
  constexpr double kRadius = 0.008;
  const SignedFunction floor(HalfSpaceFunction{Vector3d::UnitZ()});
  const SignedFunction wall(HalfSpaceFunction{Vector3d::UnitX()});
  const SignedFunction f = unite(floor, wall, kRadius);
  for (double x = 1e-4; x < kRadius; x += 1e-4) {
    const double root = std::sqrt(kRadius) - std::sqrt(x);
    EXPECT_NEAR(f.sample({x, 0.3, root * root}).value, 0.0, 1e-16);
  }
  EXPECT_EQ(f.sample({kRadius, 0.0, 0.0}).value, 0.0);
  EXPECT_EQ(f.sample({2.0 * kRadius, 0.0, 1e-3}).value, 1e-3);
  // At a convex edge the same amount is removed.
  const SignedFunction edge = intersect(floor, wall, kRadius);
  EXPECT_NEAR(edge.sample({-0.25 * kRadius, 0.0, -0.25 * kRadius}).value, 0.0, 1e-16);
  const SignedFunction cut =
      subtract(floor, SignedFunction(HalfSpaceFunction{-Vector3d::UnitX()}), kRadius);
  EXPECT_NEAR(cut.sample({-0.25 * kRadius, 0.0, -0.25 * kRadius}).value, 0.0, 1e-16);
}

TEST(SignedFunctions, NeverAdvanceBeyondTheLevel) {
  for (const test::NamedSolid& named : test::implicit_solids()) {
    SCOPED_TRACE(named.name);
    const SignedFunction& f = named.solid->function();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int useful = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p = random_point(random, 0.09);
      const Vector3d direction = random_point(random, 1.0).normalized();
      const double level = 0.003 * share(random);
      const WaySample here = f.sample_along(p, direction, level, 1e-10);
      ASSERT_EQ(here.value, f.sample(p).value);
      if (here.value <= level) continue;
      ASSERT_GE(here.advance, here.value - level);
      useful += here.advance > 1.01 * (here.value - level) ? 1 : 0;
      const double way = std::min(here.advance, 0.3);
      for (int k = 0; k < 100; ++k) {
        const Vector3d q = p + way * share(random) * direction;
        ASSERT_GE(f.sample(q).value, level - 1e-15)
            << p.transpose() << " along " << direction.transpose();
      }
    }
    EXPECT_GT(useful, named.name == "torus" ? -1 : 500) << "better than the Lipschitz constant";
  }
}

TEST(SignedFunctions, RefuseInvalidCombinations) {
  const SignedFunction ball(SphereFunction{0.01});
  EXPECT_THROW(unite(ball, ball, -1e-3), std::invalid_argument);
  SignedFunction many = ball;
  for (std::size_t i = 1; i < SignedFunction::kMostLeaves; ++i) many = unite(many, ball);
  EXPECT_EQ(many.leaves(), SignedFunction::kMostLeaves);
  EXPECT_DOUBLE_EQ(many.sample({0.03, 0.0, 0.0}).value, 0.02);
  EXPECT_THROW(unite(many, ball), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics::signed_function_test
