// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/bounding_volume_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "reckon/tests/support/random_point.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::random_point;

std::vector<Eigen::AlignedBox3d> random_boxes(std::size_t count, double scale, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Eigen::AlignedBox3d> boxes(count);
  for (Eigen::AlignedBox3d& box : boxes) {
    const Vector3d a = random_point(random, scale);
    box.extend(a);
    box.extend(Vector3d(a + random_point(random, 0.03 * scale)));
  }
  return boxes;
}

bool meets(const Eigen::AlignedBox3d& box, const Vector3d& origin, const Vector3d& step) {
  double enter = 0.0;
  double leave = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double t0 = (box.min()[i] - origin[i]) / step[i];
    const double t1 = (box.max()[i] - origin[i]) / step[i];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter <= leave;
}

TEST(BoundingVolumeTree, NeverMissesABoxOnAPath) {
  for (const double scale : {1e-3, 0.1, 10.0}) {
    const auto boxes = random_boxes(3000, scale, 1);
    const BoundingVolumeTree tree(boxes, 0.0);
    std::mt19937 random(2);
    for (int i = 0; i < 300; ++i) {
      const Vector3d origin = random_point(random, (i % 10 == 0 ? 1e4 : 1.2) * scale);
      const Vector3d step = i % 10 == 0 ? Vector3d(-2.0 * origin + random_point(random, scale))
                                        : random_point(random, (i % 2 ? 0.05 : 2.0) * scale);
      std::set<std::uint32_t> found;
      const double limit = 1.0;
      tree.along_segment(origin, step, 0.0, limit, [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t k = first; k < first + count; ++k) found.insert(tree.order()[k]);
      });
      for (std::uint32_t k = 0; k < boxes.size(); ++k) {
        if (meets(boxes[k], origin, step)) {
          ASSERT_TRUE(found.contains(k)) << "scale " << scale << " query " << i;
        }
      }
    }
  }
}

TEST(BoundingVolumeTree, NeverMissesAnIntersectingBox) {
  for (const double scale : {1e-3, 0.1, 10.0, 1e6}) {
    const auto boxes = random_boxes(3000, scale, 1);
    const BoundingVolumeTree tree(boxes, 0.0);
    std::mt19937 random(8);
    std::size_t visited = 0;
    for (int i = 0; i < 300; ++i) {
      Eigen::AlignedBox3d box(random_point(random, (i % 10 == 0 ? 1e4 : 1.2) * scale));
      if (i % 3 != 0) box.extend(Vector3d(box.min() + random_point(random, 0.05 * scale)));
      if (i % 7 == 0) box.extend(random_point(random, 2.0 * scale));
      if (i % 11 == 0) box = Eigen::AlignedBox3d(boxes[static_cast<std::size_t>(i)].max());
      std::set<std::uint32_t> found;
      tree.overlapping(box, [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t k = first; k < first + count; ++k) {
          EXPECT_TRUE(found.insert(tree.order()[k]).second) << "visited twice";
        }
      });
      visited += found.size();
      for (std::uint32_t k = 0; k < boxes.size(); ++k) {
        if (boxes[k].intersects(box)) {
          ASSERT_TRUE(found.contains(k)) << "scale " << scale << " query " << i;
        }
      }
    }
    EXPECT_LT(visited, 300u * 3000u / 8u);
  }
  BoundingVolumeTree().overlapping(Eigen::AlignedBox3d(Vector3d::Zero()),
                                   [](std::uint32_t, std::uint32_t) { FAIL() << "it is empty"; });
}

TEST(BoundingVolumeTree, VisitsFewBoxesOnAShortPath) {
  const auto boxes = random_boxes(100000, 1.0, 3);
  const BoundingVolumeTree tree(boxes, 0.0);
  std::mt19937 random(4);
  std::size_t visited = 0;
  for (int i = 0; i < 1000; ++i) {
    const double limit = 1.0;
    tree.along_segment(random_point(random, 1.0), random_point(random, 0.001), 0.0, limit,
                       [&](std::uint32_t, std::uint32_t count) { visited += count; });
  }
  EXPECT_LT(visited, 50u * 1000u);
}

TEST(BoundingVolumeTree, FindsTheNearestBoxOfAll) {
  const auto boxes = random_boxes(3000, 1.0, 5);
  const BoundingVolumeTree tree(boxes, 0.0);
  std::mt19937 random(6);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = random_point(random, i % 3 ? 1.0 : 300.0);
    double limit = std::numeric_limits<double>::infinity();
    tree.near_point(p, limit, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t k = first; k < first + count; ++k) {
        limit = std::min(limit, boxes[tree.order()[k]].exteriorDistance(p));
      }
    });
    double brute = std::numeric_limits<double>::infinity();
    for (const auto& box : boxes) brute = std::min(brute, box.exteriorDistance(p));
    ASSERT_EQ(limit, brute);
  }
}

TEST(BoundingVolumeTree, StaysShallowWithoutASplit) {
  const std::vector<Eigen::AlignedBox3d> same(
      5000, Eigen::AlignedBox3d(Vector3d::Zero(), Vector3d::Ones()));
  EXPECT_LE(BoundingVolumeTree(same, 0.0).depth(), 14);
  // Sizes and places over many powers of two: the worst case for a surface-area split.
  std::vector<Eigen::AlignedBox3d> wild;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d at = Vector3d::Constant(std::ldexp(1.0, -i));
    wild.emplace_back(at, at);
  }
  EXPECT_LE(BoundingVolumeTree(wild, 0.0).depth(), 60);
}

TEST(BoundingVolumeTree, AnswersNothingWhenEmpty) {
  const BoundingVolumeTree tree(std::span<const Eigen::AlignedBox3d>{}, 0.0);
  int visits = 0;
  const double limit = 1.0;
  tree.along_segment(Vector3d::Zero(), Vector3d::Ones(), 0.0, limit, [&](auto, auto) { ++visits; });
  tree.near_point(Vector3d::Zero(), limit, [&](auto, auto) { ++visits; });
  EXPECT_EQ(visits, 0);
}

// The first triangle on a path, compared with a check of each triangle.
void expect_first_contact(const SurfaceMesh& mesh, const Vector3d& origin, const Vector3d& step,
                          double radius, int& hits) {
  const double stop = radius + mesh.sweep_radius();
  const Sweep sweep{origin, step, stop, radius + 0.5 * mesh.sweep_radius(),
                    1e-4 * mesh.clearance()};
  SweepHit hit;
  const bool found = mesh.sweep(origin, step, radius, hit);
  TriangleHit first{2.0, Vector3d::Zero(), false};
  for (const Triangle& triangle : mesh.triangles()) {
    TriangleHit one;
    if (sweep_triangle(triangle, sweep, 1.0, one) && one.t < first.t) first = one;
  }
  ASSERT_EQ(found, first.t <= 1.0);
  if (found) {
    ASSERT_EQ(hit.t, first.t);
  }
  hits += found && hit.t > 0.0 ? 1 : 0;
}

TEST(SurfaceMesh, FirstContactEqualsBruteForce) {
  for (const double size : {1e-3, 0.2, 200.0}) {
    const SurfaceMesh mesh = test::make_mesh(test::torus(40, 20), size);
    std::mt19937 random(7);
    for (const double radius : {0.0, 1e-3, 0.01 * size, 100.0 * size}) {
      SCOPED_TRACE(testing::Message() << "size " << size << " radius " << radius);
      int hits = 0;
      for (int i = 0; i < 400; ++i) {
        const Vector3d out = random_point(random, 1.0).normalized();
        const Vector3d origin = random_point(random, 0.5 * size) + 1.01 * radius * out;
        const Vector3d step = random_point(random, (i % 2 ? 0.05 : 1.0) * (size + radius));
        ASSERT_NO_FATAL_FAILURE(expect_first_contact(mesh, origin, step, radius, hits)) << i;
      }
      EXPECT_GT(hits, 10);
    }
  }
}

TEST(SurfaceMesh, NearestPointEqualsBruteForce) {
  for (const double size : {1e-3, 0.2, 10.0}) {
    const SurfaceMesh mesh = test::make_mesh(test::torus(40, 20), size);
    std::mt19937 random(7);
    for (int i = 0; i < 400; ++i) {
      const Vector3d p = random_point(random, 0.5 * size);
      ClosestPoint nearest;
      ASSERT_TRUE(mesh.closest(p, size, nearest));
      double distance = std::numeric_limits<double>::infinity();
      for (const Triangle& triangle : mesh.triangles()) {
        distance = std::min(distance, (closest_on_triangle(triangle, p) - p).norm());
      }
      ASSERT_EQ(nearest.distance, distance);
      const auto hint =
          static_cast<std::uint32_t>(static_cast<std::size_t>(i) * 7919 % mesh.triangles().size());
      ClosestPoint from_hint;
      ASSERT_TRUE(mesh.closest_from(p, hint, from_hint));
      ASSERT_EQ(from_hint.distance, distance);
    }
  }
}

}  // namespace
}  // namespace reckon::haptics
