// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/time_of_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "reckon/tests/haptics/support/pair_oracles.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::drawn_placement;
using test::drawn_point;
using test::uniform;

constexpr double kImpactTolerance = 1e-6;

Motion moving(const Placement& start, const Vector3d& velocity,
              const Vector3d& turn_rate = Vector3d::Zero()) {
  return {start, velocity, turn_rate};
}

TEST(TimeOfImpact, FallingBallMatchesTheClosedForm) {
  for (const double speed : {1e-3, 1.0, 300.0}) {
    const Placement above{{3.0, 2.0, 1.25}, Matrix3d::Identity()};
    const ImpactTime found = time_of_impact(
        QueryShape::sphere(0.25), moving(above, {5.0, 0.0, -speed}, {0.0, 70.0, 0.0}),
        QueryShape::below_plane(Vector3d::UnitZ()), {}, 1e4, kImpactTolerance);
    ASSERT_EQ(found.outcome, Impact::hit);
    EXPECT_LE(found.time, 1.0 / speed);
    EXPECT_NEAR(found.time, 1.0 / speed, kImpactTolerance / speed * (1 + 1e-9));
  }
}

// For axis-aligned boxes: each axis overlaps for an interval of time; they meet when all intervals
// overlap.
TEST(TimeOfImpact, AlignedBoxesMatchTheClosedForm) {
  std::mt19937_64 random(1);
  int hits = 0, unknown = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Vector3d half_a = drawn_point(random, 0.3).cwiseAbs();
    const Vector3d half_b = drawn_point(random, 0.3).cwiseAbs();
    const Vector3d from = drawn_point(random, 2.0);
    const Vector3d velocity = -from + drawn_point(random, 1.0);
    double enter = 0.0, leave = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double reach = half_a[k] + half_b[k];
      const double one = (-reach - from[k]) / velocity[k], two = (reach - from[k]) / velocity[k];
      enter = std::max(enter, std::min(one, two));
      leave = std::min(leave, std::max(one, two));
    }
    const ImpactTime found =
        time_of_impact(QueryShape::box(2 * half_a), {}, QueryShape::box(2 * half_b),
                       moving({from, Matrix3d::Identity()}, velocity), 1.0, kImpactTolerance);
    if (enter < leave) {
      ++hits;
      ASSERT_NE(found.outcome, Impact::none) << i;
      ASSERT_LE(found.time, enter) << i;
      ASSERT_LE(found.measure.distance.most, kImpactTolerance) << i;
    }
    unknown += found.outcome == Impact::unknown ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
  EXPECT_EQ(unknown, 0);
}

// The exact distance of turning boxes, in steps fine enough not to jump across a contact.
TEST(TimeOfImpact, TurningBoxesMeetNoEarlierThanFound) {
  std::mt19937_64 random(2);
  constexpr int kSteps = 4'000;
  const int pairs = test::tries(120, 400);
  int hits = 0, free = 0, unknown = 0;
  for (int i = 0; i < pairs; ++i) {
    const Vector3d half(0.3, 0.05, 0.1), other_half(0.02, 0.2, 0.2);
    const Motion a =
        moving(drawn_placement(random, 0.5), drawn_point(random, 1.0), drawn_point(random, 6.0));
    Motion b =
        moving(drawn_placement(random, 0.5), drawn_point(random, 1.0), drawn_point(random, 6.0));
    b.start.position.x() += 0.8;
    b.velocity.x() -= 1.5;
    const ImpactTime found = time_of_impact(
        QueryShape::box(2 * half), a, QueryShape::box(2 * other_half), b, 1.0, kImpactTolerance);
    const auto gap = [&](double t) {
      return test::projected_gap({a.at(t), half}, {b.at(t), other_half});
    };
    double contact = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kSteps && contact > 1.0; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      if (gap(t) < 0.0) contact = t;
    }
    // The fine step overlaps, the one before does not: the contact is between.
    if (contact > 0.0 && contact <= 1.0) {
      double before = contact - 1.0 / kSteps;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (before + contact);
        (gap(middle) < 0.0 ? contact : before) = middle;
      }
    }
    ASSERT_LE(found.time, contact + 1e-12) << i;
    if (found.outcome == Impact::none) {
      ++free;
      ASSERT_GT(contact, 1.0) << i;
    } else if (found.outcome == Impact::hit && found.time > 0.0) {
      ++hits;
      const double distance =
          test::box_box_distance({a.at(found.time), half}, {b.at(found.time), other_half});
      ASSERT_LE(distance, kImpactTolerance * 1.001) << i;
      ASSERT_GT(distance, 0.0) << i;
    } else if (found.outcome == Impact::unknown) {
      ++unknown;
    }
  }
  EXPECT_GT(hits, pairs / 10);
  EXPECT_GT(free, pairs / 40);
  EXPECT_LE(unknown, pairs / 120);
}

TEST(TimeOfImpact, AnyPairMeetsNoEarlierThanFound) {
  std::mt19937_64 random(3);
  const std::vector<QueryShape> shapes{
      QueryShape::box({0.2, 0.1, 0.15}),   QueryShape::sphere(0.1),
      QueryShape::capsule(0.03, 0.3),      test::query_mesh(test::torus(16, 8), 0.3),
      test::query_mesh(test::cube(), 0.3), test::query_solid(CylinderShape{0.1, 0.1})};
  int hits = 0, all = 0;
  for (const QueryShape& a : shapes) {
    for (const QueryShape& b : shapes) {
      for (int i = 0; i < 3; ++i) {
        const Motion one =
            moving(drawn_placement(random, 0.05), Vector3d::Zero(), drawn_point(random, 3.0));
        const Placement start = drawn_placement(random, 0.2);
        Motion other = moving(start, {-2.0, 0.0, 0.0}, drawn_point(random, 3.0));
        other.start.position.x() += 1.0;
        const ImpactTime found = time_of_impact(a, one, b, other, 1.0, 1e-4);
        ++all;
        hits += found.outcome == Impact::hit ? 1 : 0;
        double contact = 2.0;
        for (int k = 0; k <= 200 && contact > 1.0; ++k) {
          if (measure_pair(a, one.at(k / 200.0), b, other.at(k / 200.0)).overlap == Overlap::yes)
            contact = k / 200.0;
        }
        ASSERT_LE(found.time, contact);
        if (found.outcome == Impact::none) {
          ASSERT_GT(contact, 1.0);
        } else if (found.outcome == Impact::hit) {
          ASSERT_LE(found.measure.distance.most, 2e-4);
        }
      }
    }
  }
  EXPECT_GT(hits, all / 2);
}

TEST(TimeOfImpact, MissesNoBulletThroughAThinPlate) {
  const QueryShape plate = QueryShape::box({1.0, 1.0, 0.0});
  for (const double speed : {1.0, 1e3, 1e6}) {
    const ImpactTime found =
        time_of_impact(plate, {}, QueryShape::sphere(1e-3),
                       moving({{0.1, 0.2, 1.001}, Matrix3d::Identity()}, {0, 0, -speed}), 10.0);
    ASSERT_EQ(found.outcome, Impact::hit);
    EXPECT_NEAR(found.time * speed, 1.0, 2e-6);
  }
}

TEST(TimeOfImpact, IsZeroForOverlapOnly) {
  const QueryShape ball = QueryShape::sphere(0.1);
  const Placement near{{0.15, 0, 0}, Matrix3d::Identity()};
  const Placement far{{0.25, 0, 0}, Matrix3d::Identity()};
  const ImpactTime within = time_of_impact(ball, {}, ball, moving(near, {1, 0, 0}), 1.0);
  EXPECT_EQ(within.outcome, Impact::hit);
  EXPECT_EQ(within.time, 0.0);
  EXPECT_EQ(time_of_impact(ball, {}, ball, moving(far, {1, 0, 0}), 1e9).outcome, Impact::none);
  EXPECT_EQ(time_of_impact(ball, {}, ball, moving(far, {0, 0, 0}), 1e9).outcome, Impact::none);
}

TEST(TimeOfImpact, ReportsAnUnknownTime) {
  const QueryShape ball = QueryShape::sphere(0.1);
  const Placement far{{0, 0, 2}, Matrix3d::Identity()};
  const ImpactTime turning =
      time_of_impact(QueryShape::below_plane(Vector3d::UnitZ()),
                     moving({}, Vector3d::Zero(), {1, 0, 0}), ball, moving(far, {0, 0, 0}), 1.0);
  EXPECT_EQ(turning.outcome, Impact::unknown);
  EXPECT_EQ(turning.time, 0.0);
  const ImpactTime nowhere = time_of_impact(ball, {}, ball, moving(far, {0, 0, std::nan("")}), 1.0);
  EXPECT_EQ(nowhere.outcome, Impact::unknown);
}

TEST(TimeOfImpact, AllocatesNothing) {
  const QueryShape box = QueryShape::box({0.1, 0.1, 0.1});
  const Placement far{{0, 0, 2}, Matrix3d::Identity()};
  const test::AllocationGuard guard;
  const ImpactTime found = time_of_impact(box, {}, box, moving(far, {0, 0, -1}, {1, 2, 3}), 5.0);
  EXPECT_EQ(found.outcome, Impact::hit);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
