// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/triangle_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using Eigen::Vector3d;
using reckon::haptics::Triangle;
using reckon::haptics::TriangleBounds;

Triangle make(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return {a, b, c, (b - a).cross(c - a).normalized()};
}

struct Random {
  std::mt19937 engine{11};
  std::uniform_real_distribution<double> unit{0.0, 1.0};
  std::normal_distribution<double> gauss;

  double share() { return unit(engine); }
  Vector3d vector() { return {gauss(engine), gauss(engine), gauss(engine)}; }
  // Within a box of diagonal 1 about `centre`; every other one is a sliver.
  Triangle triangle(const Vector3d& centre, double size, int i) {
    const Vector3d a = 0.1 * vector();
    const Vector3d b = a + 0.1 * share() * vector();
    const double thin = i % 2 == 0 ? 1.0 : std::pow(10.0, -1.0 - 8.0 * share());
    const Vector3d c = a + share() * (b - a) + 0.1 * thin * vector();
    return make(centre + size * a, centre + size * b, centre + size * c);
  }
};

// Any point of a triangle is at least as far as the nearest one, so none may be nearer than the
// bound.
TEST(TriangleBounds, NeverExceedTheDistanceOfAnyPoint) {
  Random random;
  int beyond = 0;
  int beside = 0;
  for (const double size : {1e-3, 0.2, 200.0}) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3d centre = 5.0 * size * random.vector();
      const std::vector<Triangle> one{random.triangle(centre, size, i)};
      const TriangleBounds bounds(one, centre, size);
      const Triangle& t = one[0];
      for (int k = 0; k < 20; ++k) {
        const double u = random.share();
        const double v = (1.0 - u) * (k % 3 == 0 ? 0.0 : random.share());
        const Vector3d on = t.a + u * (t.b - t.a) + v * (t.c - t.a);
        const double reach = std::pow(10.0, -9.0 + 10.0 * random.share());
        const Vector3d p = on + reach * size * random.vector();
        const auto place = bounds.place(p);
        ASSERT_FALSE(bounds.beyond(0, place, (p - on).norm() * (1.0 + 1e-9)))
            << "size " << size << ", triangle " << i;
        // From a point off the triangle, past one within `away` of it, to another point.
        const double away = (p - on).norm();
        const Vector3d from = p + size * random.vector();
        const Vector3d to = p + random.share() * (p - from);
        ASSERT_FALSE(bounds.beside(0, bounds.segment(from, to, away * (1.0 + 1e-9))))
            << "size " << size << ", triangle " << i;
        ASSERT_LE(static_cast<double>(bounds.distance_below(0, place)), away * (1.0 + 1e-9));
        beside += bounds.beside(0, bounds.segment(p, p + 0.1 * (p - on), 0.5 * away)) ? 1 : 0;
        beyond += bounds.beyond(0, place, 0.5 * (p - on).norm()) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(beyond, 20'000);  // of 120,000: the test is not trivial
  EXPECT_GT(beside, 20'000);
}

TEST(TriangleBounds, BoundDistancesOffPlaneAndAcrossSides) {
  const std::vector<Triangle> one{make({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  const TriangleBounds bounds(one, {0.5, 0.5, 0.0}, std::sqrt(2.0));
  // 0.3 above and 0.4 beyond a side, for each side: 0.5 away.
  for (const double z : {0.3, -0.3}) {
    for (const Vector3d& p :
         {Vector3d(0.4, -0.4, z), Vector3d(-0.4, 0.4, z),
          Vector3d(0.5 + 0.4 / std::sqrt(2.0), 0.5 + 0.4 / std::sqrt(2.0), z)}) {
      EXPECT_TRUE(bounds.beyond(0, bounds.place(p), 0.4999));
      EXPECT_FALSE(bounds.beyond(0, bounds.place(p), 0.5));
    }
    EXPECT_TRUE(bounds.beyond(0, bounds.place({0.2, 0.2, z}), 0.2999));
    EXPECT_FALSE(bounds.beyond(0, bounds.place({0.2, 0.2, z}), 0.3));
  }
}

TEST(TriangleBounds, BoundNothingBeyondInfinityOrZeroDistance) {
  const std::vector<Triangle> one{make({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  const TriangleBounds bounds(one, {0.5, 0.5, 0.0}, std::sqrt(2.0));
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const double far : {1.0, 1e9, 1e30, 1e300}) {
    EXPECT_FALSE(bounds.beyond(0, bounds.place(Vector3d::Constant(far)), kNone)) << far;
  }
  EXPECT_FALSE(bounds.beyond(0, bounds.place({0.2, 0.2, 0.0}), 0.0));
  EXPECT_FALSE(bounds.beyond(0, bounds.place({0.2, 0.2, 0.0}), 1e-30));
}

}  // namespace
