// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reckon/haptics/queries/pair_query.hpp"
#include "reckon/tests/haptics/support/pair_oracles.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::box_box_distance;
using test::drawn_placement;
using test::OracleBox;
using test::projected_gap;
using test::uniform;

Vector3d drawn_half(std::mt19937_64& random) {
  return {std::exp(uniform(random, -3, 0)), std::exp(uniform(random, -3, 0)),
          std::exp(uniform(random, -3, 0))};
}

TEST(BoxPair, OverlapsByTheProjectionsOfTheCorners) {
  std::mt19937_64 random(1);
  const int pairs = test::tries(200'000, 1'000'000);
  int overlaps = 0;
  double worst = 0.0;
  for (int i = 0; i < pairs; ++i) {
    const OracleBox a{drawn_placement(random, 0.5), drawn_half(random)};
    const OracleBox b{drawn_placement(random, 0.5), drawn_half(random)};
    const double gap = projected_gap(a, b);
    const PairMeasure m =
        measure_pair(QueryShape::box(2 * a.half), a.at, QueryShape::box(2 * b.half), b.at);
    if (std::abs(gap) < 1e-12) continue;
    ASSERT_EQ(m.overlap, gap < 0.0 ? Overlap::yes : Overlap::no) << i << ": gap " << gap;
    if (gap > 0.0) {
      ASSERT_GE(m.distance.least, gap - 1e-12) << i;
      continue;
    }
    ++overlaps;
    worst = std::max(worst, std::abs(m.depth.most + gap));
    ASSERT_EQ(m.depth.least, m.depth.most);
    ASSERT_NEAR(m.depth.most, -gap, 1e-12) << i;
    if (i % 16 != 0) continue;
    // The direction separates them, by no more than necessary.
    OracleBox moved = b;
    moved.at.position += m.depth.most * m.direction;
    ASSERT_NEAR(projected_gap(a, moved), 0.0, 1e-12) << i;
  }
  EXPECT_GT(overlaps, pairs / 10 * 3);
  EXPECT_LT(overlaps, pairs / 10 * 9);
  RecordProperty("worst_depth_error_m", std::to_string(worst));
}

// The least violated axis of axis-aligned boxes (thesis 5.3): on a raster of 1/64 m every sum is
// exact, and many pairs have two or three equally violated axes.
TEST(BoxPair, SeparatesAlignedBoxesAlongTheLeastViolatedAxis) {
  std::mt19937_64 random(2);
  const auto raster = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random) / 64.0;
  };
  const int pairs = test::tries(200'000, 1'000'000);
  int ties = 0, overlaps = 0;
  for (int i = 0; i < pairs; ++i) {
    const Vector3d half_a(raster(1, 16), raster(1, 16), raster(1, 16));
    const Vector3d half_b(raster(1, 16), raster(1, 16), raster(1, 16));
    const Placement a{{raster(-16, 16), raster(-16, 16), raster(-16, 16)}, Matrix3d::Identity()};
    const Placement b{{raster(-16, 16), raster(-16, 16), raster(-16, 16)}, Matrix3d::Identity()};
    const PairMeasure m =
        measure_pair(QueryShape::box(2 * half_a), a, QueryShape::box(2 * half_b), b);
    const Vector3d between = b.position - a.position;
    const Vector3d violation = half_a + half_b - between.cwiseAbs();
    if (violation.minCoeff() <= 0.0) {
      ASSERT_EQ(m.overlap, Overlap::no) << i;
      ASSERT_NEAR(m.distance.most, (-violation).cwiseMax(0.0).norm(), 1e-14) << i;
      continue;
    }
    ++overlaps;
    int axis = 0;
    for (int k = 1; k < 3; ++k) axis = violation[k] < violation[axis] ? k : axis;
    ties += (violation.array() == violation[axis]).count() > 1 ? 1 : 0;
    ASSERT_EQ(m.overlap, Overlap::yes) << i;
    ASSERT_EQ(m.depth.most, violation[axis]) << i;
    ASSERT_EQ(std::abs(m.direction[axis]), 1.0) << i;
    if (between[axis] == 0.0) continue;
    ASSERT_EQ(m.direction[axis] > 0.0, between[axis] > 0.0) << i;
  }
  EXPECT_GT(overlaps, pairs / 10);
  EXPECT_GT(ties, pairs / 100);
}

void expect_distance(const OracleBox& a, const OracleBox& b, double tolerance) {
  const PairMeasure m =
      measure_pair(QueryShape::box(2 * a.half), a.at, QueryShape::box(2 * b.half), b.at);
  const double gap = projected_gap(a, b);
  if (gap < tolerance) {
    EXPECT_LE(m.distance.most, std::max(0.0, box_box_distance(a, b)) + tolerance);
    return;
  }
  const double distance = box_box_distance(a, b);
  ASSERT_EQ(m.overlap, Overlap::no);
  ASSERT_EQ(m.distance.least, m.distance.most);
  ASSERT_NEAR(m.distance.most, distance, tolerance);
  ASSERT_NEAR((m.on_b - m.on_a).norm(), distance, tolerance + 4e-16 * a.at.position.norm());
  ASSERT_LT(a.distance_of(m.on_a), tolerance + 4e-16 * a.at.position.norm());
  ASSERT_LT(b.distance_of(m.on_b), tolerance + 4e-16 * a.at.position.norm());
}

TEST(BoxPair, DistanceIsThatOfTheNearestFeatures) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20'000; ++i) {
    const OracleBox a{drawn_placement(random, 1.0), drawn_half(random)};
    const OracleBox b{drawn_placement(random, 1.0), drawn_half(random)};
    expect_distance(a, b, 1e-12);
    if (HasFatalFailure()) FAIL() << "pair " << i;
  }
}

TEST(BoxPair, IsExactForNeedlesPlatesAndPoints) {
  std::mt19937_64 random(4);
  const std::array<double, 5> extents{1.0, 1e-6, 0.0, 1e-3, 0.3};
  const auto extent = [&] { return extents[random() % extents.size()]; };
  for (int i = 0; i < 20'000; ++i) {
    const OracleBox a{drawn_placement(random, 0.6), {extent(), extent(), extent()}};
    const OracleBox b{drawn_placement(random, 0.6), {extent(), extent(), extent()}};
    expect_distance(a, b, 1e-12);
    if (HasFatalFailure()) FAIL() << "pair " << i;
  }
}

TEST(BoxPair, IsExactForParallelAndTouchingBoxes) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20'000; ++i) {
    OracleBox a{drawn_placement(random, 1.0), drawn_half(random)};
    OracleBox b{a.at, drawn_half(random)};
    const double tilt = std::array{0.0, 1e-15, 1e-12, 1e-9, 1e-6}[random() % 5];
    b.at.orientation =
        Eigen::AngleAxisd(tilt, test::drawn_point(random, 1.0).normalized()) * a.at.orientation;
    Vector3d place = test::drawn_point(random, 1.0);
    const Eigen::Index axis = static_cast<Eigen::Index>(random() % 3);
    const double gap = std::array{0.0, 1e-15, 1e-9, 1e-3}[random() % 4];
    place[axis] = a.half[axis] + b.half[axis] + gap;
    b.at.position = a.at.to_scene(place);
    expect_distance(a, b, 1e-12);
    if (HasFatalFailure()) FAIL() << "pair " << i << " tilt " << tilt << " gap " << gap;
  }
}

TEST(BoxPair, IsExactFarFromTheOrigin) {
  std::mt19937_64 random(6);
  const Vector3d far(6.4e6, -2e6, 1e6);
  for (int i = 0; i < 5'000; ++i) {
    OracleBox a{drawn_placement(random, 1.0), drawn_half(random)};
    OracleBox b{drawn_placement(random, 1.0), drawn_half(random)};
    a.at.position += far;
    b.at.position += far;
    const PairMeasure m =
        measure_pair(QueryShape::box(2 * a.half), a.at, QueryShape::box(2 * b.half), b.at);
    a.at.position -= far;  // exact: the rounding came from the sums above
    b.at.position -= far;
    const double gap = projected_gap(a, b);
    if (std::abs(gap) < 1e-12) continue;
    ASSERT_NEAR(m.distance.most, gap > 0.0 ? box_box_distance(a, b) : 0.0, 1e-12) << i;
    ASSERT_NEAR(m.depth.most, std::max(0.0, -gap), 1e-12) << i;
  }
}

TEST(BoxPair, WarmStartGivesTheSameResult) {
  std::mt19937_64 random(7);
  const QueryShape a = QueryShape::box({0.2, 0.3, 0.1});
  const QueryShape b = QueryShape::box({0.1, 0.5, 0.2});
  Placement at = drawn_placement(random, 0.1);
  at.position.x() += 1.0;
  PairMemory memory;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d axis = test::drawn_point(random, 1.0);
    at.orientation = Eigen::AngleAxisd(0.02, axis.normalized()) * at.orientation;
    at.position += 0.01 * test::drawn_point(random, 1.0);
    const PairMeasure warm = measure_pair(a, {}, b, at, memory);
    const PairMeasure cold = measure_pair(a, {}, b, at);
    ASSERT_EQ(warm.overlap, cold.overlap);
    ASSERT_NEAR(warm.distance.most, cold.distance.most, 1e-13);
    ASSERT_EQ(warm.depth.most, cold.depth.most);
  }
}

TEST(BoxPair, AllocatesNothing) {
  std::mt19937_64 random(8);
  const QueryShape a = QueryShape::box({0.2, 0.3, 0.1});
  const QueryShape b = QueryShape::capsule(0.05, 0.4);
  PairMemory memory;
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    const Placement at = drawn_placement(random, 0.4);
    static_cast<void>(measure_pair(a, {}, b, at, memory));
    static_cast<void>(measure_pair(a, {}, a, at, memory));
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
