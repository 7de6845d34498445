// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/way_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "reckon/haptics/queries/pair_query.hpp"
#include "reckon/tests/haptics/support/pair_oracles.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::query_mesh;

Placement unturned(const Vector3d& position) { return {position, Matrix3d::Identity()}; }

TEST(WayOut, IsTheLeastTranslationOutOfABox) {
  const WayOut way = way_out(QueryShape::box({1, 1, 1}), {}, QueryShape::box({0.2, 0.2, 0.2}),
                             unturned({0.1, 0.45, -0.2}));
  EXPECT_NEAR(way.way, 0.15, 1e-15);
  EXPECT_EQ(way.direction, Vector3d::UnitY());
}

TEST(WayOut, CubeMeshEqualsTheCube) {
  const QueryShape cube = query_mesh(test::cube(), std::sqrt(3.0));
  const QueryShape box = QueryShape::box({0.2, 0.2, 0.2});
  for (const Vector3d& place : {Vector3d(0.1, 0.45, -0.2), Vector3d(0.05, 0.2, -0.59999)}) {
    const WayOut expected = way_out(QueryShape::box({1, 1, 1}), {}, box, unturned(place));
    const WayOut way = way_out(cube, {}, box, unturned(place));
    EXPECT_NEAR(way.way, expected.way, 2e-6);
    EXPECT_LT((way.direction - expected.direction).norm(), 1e-12);
  }
}

TEST(WayOut, RestingBoxIsWithinTheTolerance) {
  const WayOut way = way_out(query_mesh(test::cube(), std::sqrt(3.0)), {},
                             QueryShape::box({0.2, 0.2, 0.2}), unturned({0.1, 0.2, 0.6}));
  EXPECT_LE(way.way, 2e-6);
}

// At the inner side of its tube the hole is near, the border of its bounding box is not.
TEST(WayOut, LeadsIntoTheHoleOfARing) {
  const test::MeshData data = test::torus(48, 24);
  const QueryShape ring = query_mesh(data, 1.0);
  const double unit = ring.bounds().max().x() / 1.4;
  const QueryShape small = QueryShape::box({0.02, 0.02, 0.02});
  const Placement at_hole = unturned({0.62 * unit, 0, 0});
  const PairMeasure bounds = measure_pair(ring, {}, small, at_hole);
  ASSERT_EQ(bounds.overlap, Overlap::yes);
  const WayOut way = way_out(ring, {}, small, at_hole);
  EXPECT_NEAR(way.way, 0.02 * unit + 0.01, 0.004 * unit);
  EXPECT_LT((way.direction + Vector3d::UnitX()).norm(), 0.1);
  EXPECT_GT(bounds.depth.most, 1.5 * way.way);
}

TEST(WayOut, SeparatesAllOverlappingShapes) {
  std::mt19937_64 random(1);
  const QueryShape a = query_mesh(test::groove(), 0.3);
  const QueryShape b = query_mesh(test::torus(16, 8), 0.3);
  int overlaps = 0;
  for (int i = 0; i < 20; ++i) {
    const Placement one = test::drawn_placement(random, 0.05);
    Placement other = test::drawn_placement(random, 0.1);
    const WayOut way = way_out(a, one, b, other);
    if (way.way == 0.0) continue;
    ++overlaps;
    other.position += way.way * way.direction;
    ASSERT_EQ(measure_pair(a, one, b, other).overlap, Overlap::no);
  }
  EXPECT_GT(overlaps, 5);
}

TEST(WayOut, IsZeroForSeparateShapes) {
  EXPECT_EQ(way_out(QueryShape::sphere(0.1), {}, QueryShape::sphere(0.1), unturned({1, 0, 0})).way,
            0.0);
}

}  // namespace
}  // namespace reckon::haptics
