// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/pair_query.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "reckon/tests/haptics/support/pair_oracles.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::all_triangles;
using test::corners_of;
using test::drawn_placement;
using test::drawn_point;
using test::query_mesh;
using test::query_solid;
using test::uniform;

const SurfaceMesh& mesh_of(const QueryShape& shape) {
  return *std::get<std::shared_ptr<const SurfaceMesh>>(shape.form());
}

CsgShape bored_plate() {
  CsgShape plate;
  plate.parts.push_back({CsgOperation::add, BoxShape{{0.2, 0.2, 0.05}}});
  plate.parts.push_back({CsgOperation::subtract, CylinderShape{0.04, 0.2}});
  return plate;
}

/// One shape of every kind, some 0.2 m large.
std::vector<QueryShape> all_kinds() {
  return {QueryShape::below_plane({0.1, 0.2, 1.0}),
          QueryShape::box({0.2, 0.1, 0.15}),
          QueryShape::sphere(0.08),
          QueryShape::capsule(0.03, 0.2),
          QueryShape::box({0.2, 0.0, 0.1}),
          query_mesh(test::torus(16, 8), 0.25),
          query_mesh(test::cube(), 0.2),
          query_solid(CylinderShape{0.06, 0.12}),
          query_solid(TorusShape{0.08, 0.03}),
          query_solid(bored_plate())};
}

TEST(PairQuery, SphereDistanceIsItsClosedForm) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10'000; ++i) {
    const Placement a = drawn_placement(random, 1.0), b = drawn_placement(random, 1.0);
    const double r = uniform(random, 0.0, 1.0), s = uniform(random, 0.0, 1.0);
    const PairMeasure m = measure_pair(QueryShape::sphere(r), a, QueryShape::sphere(s), b);
    const double gap = (b.position - a.position).norm() - r - s;
    ASSERT_EQ(m.overlap, gap < 0.0 ? Overlap::yes : Overlap::no);
    ASSERT_NEAR(m.distance.most, std::max(0.0, gap), 1e-14);
    ASSERT_NEAR(m.depth.most, std::max(0.0, -gap), 1e-14);
    ASSERT_LT((m.direction - (b.position - a.position).normalized()).norm(), 1e-14);
  }
}

TEST(PairQuery, ConcentricSpheresSeparateByBothRadii) {
  const PairMeasure m = measure_pair(QueryShape::sphere(0.1), {}, QueryShape::sphere(0.05), {});
  EXPECT_EQ(m.overlap, Overlap::yes);
  EXPECT_NEAR(m.depth.most, 0.15, 1e-16);
  EXPECT_NEAR(m.direction.norm(), 1.0, 1e-16);
}

TEST(PairQuery, CapsuleDistanceIsItsSegmentsLessRadii) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20'000; ++i) {
    const double length = i % 5 == 0 ? 0.0 : uniform(random, 0.0, 1.0);
    const double thin = i % 3 == 0 ? 1e-6 : uniform(random, 0.0, 0.3);
    const Placement a = drawn_placement(random, 0.6);
    Placement b = drawn_placement(random, 0.6);
    if (i % 4 == 0) b.orientation = a.orientation;  // parallel
    const auto end = [](const Placement& at, double z) { return at.to_scene({0, 0, z}); };
    const double gap = test::segment_segment(end(a, -0.5), end(a, 0.5), end(b, -0.5 * length),
                                             end(b, 0.5 * length)) -
                       thin - 0.05;
    const PairMeasure m =
        measure_pair(QueryShape::capsule(thin, 1.0), a, QueryShape::capsule(0.05, length), b);
    ASSERT_NEAR(m.distance.most, std::max(0.0, gap), 1e-13) << i;
    ASSERT_NEAR(m.depth.most, std::max(0.0, -gap), 1e-13) << i;
  }
}

TEST(PairQuery, CrossingCapsulesSeparateAcrossBoth) {
  Placement b;
  b.orientation = Eigen::AngleAxisd(0.5, Vector3d::UnitX()).toRotationMatrix();
  const PairMeasure m =
      measure_pair(QueryShape::capsule(0.02, 1.0), {}, QueryShape::capsule(0.03, 1.0), b);
  EXPECT_EQ(m.overlap, Overlap::yes);
  EXPECT_NEAR(m.depth.most, 0.05, 1e-15);
  EXPECT_NEAR(std::abs(m.direction.x()), 1.0, 1e-15);
}

// Outside: distance from the clamped middle. Inside: to the nearest face.
TEST(PairQuery, BoxesAndSpheresMatchTheirClosedForm) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d half(uniform(random, 0.01, 0.5), uniform(random, 1e-6, 1e-5),
                        uniform(random, 0.01, 0.5));
    const double r = i % 4 == 0 ? 0.0 : uniform(random, 0.0, 0.3);
    const Placement box = drawn_placement(random, 0.3), ball = drawn_placement(random, 0.3);
    const Vector3d c = box.to_shape(ball.position).cwiseAbs() - half;
    const double gap = (c.maxCoeff() > 0.0 ? c.cwiseMax(0.0).norm() : c.maxCoeff()) - r;
    const PairMeasure m = measure_pair(QueryShape::box(2 * half), box, QueryShape::sphere(r), ball);
    ASSERT_NEAR(m.distance.most, std::max(0.0, gap), 1e-14) << i;
    ASSERT_NEAR(m.depth.most, std::max(0.0, -gap), 1e-14) << i;
  }
}

TEST(PairQuery, PlaneDistanceIsToTheLowestPoint) {
  std::mt19937_64 random(4);
  const QueryShape plane = QueryShape::below_plane({0, 0, 3});
  const QueryShape mesh = query_mesh(test::torus(24, 12), 0.3);
  for (int i = 0; i < 1'000; ++i) {
    const Placement at = drawn_placement(random, 0.3), ground = drawn_placement(random, 0.3);
    const auto height = [&](const Vector3d& p) {
      return ground.orientation.col(2).dot(p - ground.position);
    };
    double lowest = 1e300;
    for (const test::Corners& t : corners_of(mesh_of(mesh), at))
      for (const Vector3d& p : t) lowest = std::min(lowest, height(p));
    const PairMeasure m = measure_pair(mesh, at, plane, ground);
    ASSERT_NEAR(m.distance.most - m.depth.most, lowest, 1e-14);

    const test::OracleBox box{at, {0.1, 0.2, 0.05}};
    lowest = 1e300;
    for (const Vector3d& p : box.corners()) lowest = std::min(lowest, height(p));
    const PairMeasure b = measure_pair(QueryShape::box(2 * box.half), at, plane, ground);
    ASSERT_NEAR(b.distance.most - b.depth.most, lowest, 1e-14);
    ASSERT_EQ(b.overlap, lowest < 0.0 ? Overlap::yes : Overlap::no);
  }
}

TEST(PairQuery, MeshDistanceIsThatOfTheNearestTriangles) {
  std::mt19937_64 random(5);
  const QueryShape a = query_mesh(test::torus(16, 8), 0.3);
  const QueryShape b = query_mesh(test::groove(), 0.2);
  int apart = 0;
  PairMemory memory;
  for (int i = 0; i < 200; ++i) {
    const Placement at = drawn_placement(random, 0.15), other = drawn_placement(random, 0.2);
    const double distance =
        all_triangles(corners_of(mesh_of(a), at), corners_of(mesh_of(b), other));
    const PairMeasure m = measure_pair(a, at, b, other, memory);
    if (distance == 0.0) {
      ASSERT_EQ(m.overlap, Overlap::yes) << i;
      ASSERT_EQ(m.distance.most, 0.0) << i;
      continue;
    }
    ++apart;
    ASSERT_EQ(m.overlap, Overlap::no) << i;
    ASSERT_NEAR(m.distance.most, distance, 1e-13) << i;
    ASSERT_NEAR((m.on_b - m.on_a).norm(), distance, 1e-13) << i;
  }
  EXPECT_GT(apart, 50);
  EXPECT_LT(apart, 180);
}

TEST(PairQuery, MeshDistanceToShapesUsesTheNearestTriangle) {
  std::mt19937_64 random(6);
  const QueryShape mesh = query_mesh(test::torus(16, 8), 0.3);
  const QueryShape cube_mesh = query_mesh(test::cube(), std::sqrt(3.0));  // edges of 1 m
  const double radius = 0.01;
  for (int i = 0; i < 1'000; ++i) {
    const Placement at = drawn_placement(random, 0.25), other = drawn_placement(random, 0.25);
    // A needle triangle without area has the distance of a segment.
    const std::vector<test::Corners> needle{
        {other.to_scene({0, 0, -0.1}), other.to_scene({0, 0, 0.1}), other.to_scene({0, 0, -0.1})}};
    double distance = 1e300;
    for (const test::Corners& t : corners_of(mesh_of(mesh), at)) {
      for (std::size_t k = 0; k < 3; ++k)
        distance = std::min(
            distance, test::segment_segment(needle[0][0], needle[0][1], t[k], t[(k + 1) % 3]));
      const Vector3d n = test::normal_of(t).normalized();
      const double from = n.dot(needle[0][0] - t[0]), to = n.dot(needle[0][1] - t[0]);
      for (std::size_t k = 0; k < 2; ++k)
        if (test::foot_inside(t, needle[0][k]))
          distance = std::min(distance, std::abs(k == 0 ? from : to));
      if (from * to < 0 &&
          test::foot_inside(t, needle[0][0] + from / (from - to) * (needle[0][1] - needle[0][0])))
        distance = 0.0;
    }
    const PairMeasure m = measure_pair(mesh, at, QueryShape::capsule(radius, 0.2), other);
    if (m.overlap == Overlap::no) {
      ASSERT_NEAR(m.distance.most, distance - radius, 1e-13) << i;
    } else {
      ASSERT_TRUE(distance < radius || mesh_of(mesh).contains(at.to_shape(other.position))) << i;
    }

    // A mesh of a cube has the distance of the cube.
    Placement far = other;
    far.position += 1.2 * far.position.normalized();
    const PairMeasure surface =
        measure_pair(cube_mesh, at, QueryShape::box({0.4, 0.3, 0.001}), far);
    const PairMeasure solid =
        measure_pair(QueryShape::box({1, 1, 1}), at, QueryShape::box({0.4, 0.3, 0.001}), far);
    ASSERT_EQ(surface.overlap, solid.overlap) << i;
    ASSERT_NEAR(surface.distance.most, solid.distance.most, 1e-12) << i;
    ASSERT_LE(surface.depth.least, solid.depth.most + 1e-12) << i;
    ASSERT_GE(surface.depth.most, solid.depth.most - 1e-12) << i;
  }
}

TEST(PairQuery, ShapesInsideAClosedMeshOverlapIt) {
  const QueryShape mesh = query_mesh(test::cube(), std::sqrt(3.0));
  for (const QueryShape& small :
       {QueryShape::box({0.1, 0.1, 0.1}), QueryShape::sphere(0.05),
        query_mesh(test::torus(8, 6), 0.1), query_solid(CylinderShape{0.05, 0.1})}) {
    const Placement at{{0.3, 0.1, 0.0}, Matrix3d::Identity()};
    const PairMeasure m = measure_pair(mesh, {}, small, at);
    EXPECT_EQ(m.overlap, Overlap::yes);
    EXPECT_GE(m.depth.most, 0.2);
    EXPECT_LE(m.depth.least, 0.25 + 1e-9);
    Placement moved = at;
    moved.position += m.depth.most * m.direction * (1 + 1e-9);
    EXPECT_EQ(measure_pair(mesh, {}, small, moved).overlap, Overlap::no);
  }
  const PairMeasure ball =
      measure_pair(mesh, {}, QueryShape::sphere(0.05), {{0.3, 0.1, 0.0}, Matrix3d::Identity()});
  EXPECT_NEAR(ball.depth.most, 0.25, 1e-9);
  EXPECT_NEAR(ball.direction.x(), 1.0, 1e-9);
}

TEST(PairQuery, BoundsOfASolidContainTheTruth) {
  std::mt19937_64 random(7);
  // The same box as a solid and as a box; a ball likewise.
  const QueryShape solid_box = query_solid([] {
    CsgShape box;
    box.parts.push_back({CsgOperation::add, BoxShape{{0.2, 0.3, 0.1}}});
    return box;
  }());
  const QueryShape box = QueryShape::box({0.2, 0.3, 0.1});
  const QueryShape solid_ball = query_solid(EllipsoidShape{{0.1, 0.1, 0.1}});
  const QueryShape ball = QueryShape::sphere(0.1);
  const QueryShape mesh = query_mesh(test::cube(), 0.2);
  const std::vector<QueryShape> others{
      ball,      QueryShape::capsule(0.02, 0.3),     QueryShape::box({0.1, 0.4, 0.02}),
      mesh,      QueryShape::below_plane({0, 0, 1}), solid_box,
      solid_ball};
  double widest = 0.0;
  int known = 0, overlaps = 0;
  for (int i = 0; i < 2'000; ++i) {
    const bool round = i % 2 == 0;
    const std::size_t k = random() % others.size();
    const QueryShape& other = others[k];
    const QueryShape& twin = k == 5 ? box : k == 6 ? ball : other;
    const Placement at = drawn_placement(random, 0.2), there = drawn_placement(random, 0.2);
    const PairMeasure truth = measure_pair(round ? ball : box, at, twin, there);
    const PairMeasure m = measure_pair(round ? solid_ball : solid_box, at, other, there);
    ASSERT_LE(m.distance.least, truth.distance.most + 1e-9) << i << " kind " << k;
    ASSERT_GE(m.distance.most, truth.distance.least - 1e-9) << i << " kind " << k;
    ASSERT_LE(m.depth.least, truth.depth.most + 1e-9) << i << " kind " << k;
    ASSERT_GE(m.depth.most, truth.depth.least - 1e-9) << i << " kind " << k;
    if (m.overlap == Overlap::unknown) continue;
    ++known;
    ASSERT_EQ(m.overlap, truth.overlap) << i << " kind " << k;
    if (m.overlap == Overlap::yes) ++overlaps;
    if (m.overlap == Overlap::no) widest = std::max(widest, m.distance.most - m.distance.least);
  }
  EXPECT_GT(known, 1'950);
  EXPECT_GT(overlaps, 300);
  EXPECT_LT(widest, 0.01);
}

TEST(PairQuery, BoundsOfConvexSolidsAreClose) {
  std::mt19937_64 random(12);
  const QueryShape one = query_solid(CylinderShape{0.06, 0.12});
  const QueryShape other = query_solid(EllipsoidShape{{0.1, 0.05, 0.03}});
  std::vector<double> widths;
  for (int i = 0; i < 200; ++i) {
    const PairMeasure m =
        measure_pair(one, drawn_placement(random, 0.15), other, drawn_placement(random, 0.15));
    if (m.overlap == Overlap::no) widths.push_back(m.distance.most - m.distance.least);
  }
  std::sort(widths.begin(), widths.end());
  ASSERT_GT(widths.size(), 100u);
  EXPECT_LT(widths[widths.size() / 2], 1e-8);
  EXPECT_LT(widths[widths.size() * 95 / 100], 1e-6);
}

TEST(PairQuery, ExchangedShapesGiveTheSameResult) {
  std::mt19937_64 random(8);
  const std::vector<QueryShape> kinds = all_kinds();
  for (const QueryShape& a : kinds) {
    for (const QueryShape& b : kinds) {
      for (int i = 0; i < 20; ++i) {
        const Placement at = drawn_placement(random, 0.15), other = drawn_placement(random, 0.15);
        const PairMeasure one = measure_pair(a, at, b, other);
        const PairMeasure two = measure_pair(b, other, a, at);
        ASSERT_EQ(one.overlap, two.overlap);
        ASSERT_EQ(one.distance.least, two.distance.least);
        ASSERT_EQ(one.distance.most, two.distance.most);
        ASSERT_EQ(one.depth.least, two.depth.least);
        ASSERT_EQ(one.depth.most, two.depth.most);
        ASSERT_EQ(one.direction, Vector3d(-two.direction));
        ASSERT_EQ(one.on_a, two.on_b);
        ASSERT_EQ(one.on_b, two.on_a);
      }
    }
  }
}

// Shapes of about 1 m; at 6400 km a coordinate is rounded to 1 nm.
TEST(PairQuery, CommonRigidMotionChangesOnlyRounding) {
  std::mt19937_64 random(9);
  const std::vector<QueryShape> kinds = all_kinds();
  for (const double reach : {1.0, 6.4e6}) {
    const double tolerance = reach > 1e6 ? 2e-8 : 1e-13;
    for (const QueryShape& a : kinds) {
      for (const QueryShape& b : kinds) {
        if (!a.is_bounded() && !b.is_bounded()) continue;
        for (int i = 0; i < 10; ++i) {
          const Placement at = drawn_placement(random, 0.15), other = drawn_placement(random, 0.15);
          const Placement motion = drawn_placement(random, reach);
          const auto moved = [&](const Placement& p) {
            return Placement{motion.to_scene(p.position), motion.orientation * p.orientation};
          };
          const PairMeasure one = measure_pair(a, at, b, other);
          const PairMeasure two = measure_pair(a, moved(at), b, moved(other));
          // The bounds of a solid may move, but must still overlap.
          SCOPED_TRACE("kinds " + std::to_string(&a - kinds.data()) + " and " +
                       std::to_string(&b - kinds.data()));
          ASSERT_LE(one.distance.least, two.distance.most + tolerance);
          ASSERT_LE(two.distance.least, one.distance.most + tolerance);
          ASSERT_LE(one.depth.least, two.depth.most + tolerance);
          ASSERT_LE(two.depth.least, one.depth.most + tolerance);
        }
      }
    }
  }
}

TEST(PairQuery, DepthSeparatesTheShapes) {
  std::mt19937_64 random(10);
  const std::vector<QueryShape> kinds = all_kinds();
  int overlaps = 0;
  for (const QueryShape& a : kinds) {
    for (const QueryShape& b : kinds) {
      if (!a.is_bounded() && !b.is_bounded()) continue;
      for (int i = 0; i < 10; ++i) {
        const Placement at = drawn_placement(random, 0.08);
        Placement other = drawn_placement(random, 0.08);
        const PairMeasure m = measure_pair(a, at, b, other);
        if (m.overlap == Overlap::no) {
          ASSERT_EQ(m.depth.most, 0.0);
          continue;
        }
        ++overlaps;
        ASSERT_TRUE(std::isfinite(m.depth.most));
        ASSERT_NEAR(m.direction.norm(), 1.0, 1e-12);
        other.position += (m.depth.most + 1e-6) * m.direction;
        ASSERT_NE(measure_pair(a, at, b, other).overlap, Overlap::yes);
        ASSERT_GT(measure_pair(a, at, b, other).distance.most, 0.0);
      }
    }
  }
  EXPECT_GT(overlaps, 300);
}

TEST(PairQuery, AllocatesNothingForAnyPair) {
  std::mt19937_64 random(11);
  const std::vector<QueryShape> kinds = all_kinds();
  const test::AllocationGuard guard;
  PairMemory memory;
  for (const QueryShape& a : kinds) {
    for (const QueryShape& b : kinds) {
      memory = {};
      for (int i = 0; i < 3; ++i)
        static_cast<void>(
            measure_pair(a, drawn_placement(random, 0.2), b, drawn_placement(random, 0.2), memory));
    }
  }
  EXPECT_EQ(guard.count(), 0u);
}

TEST(PairQuery, RefusesInvalidExtents) {
  EXPECT_THROW(QueryShape::box({1.0, -0.1, 1.0}), std::invalid_argument);
  EXPECT_THROW(QueryShape::sphere(std::nan("")), std::invalid_argument);
  EXPECT_THROW(QueryShape::capsule(0.1, -1.0), std::invalid_argument);
  EXPECT_THROW(QueryShape::below_plane(Vector3d::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics
