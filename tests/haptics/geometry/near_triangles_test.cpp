// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sweep with a list of near triangles gives the same result as one through the tree, to the last
// bit.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics::near_triangles_test {
namespace {

using Eigen::Vector3d;

struct Random {
  std::mt19937 engine{23};
  std::normal_distribution<double> gauss;
  Vector3d vector() { return {gauss(engine), gauss(engine), gauss(engine)}; }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }
};

// Each path starts at the end of the last one. Most are short, some go into the solid or across it,
// with a jump now and then. Starts are above the surface, on it within the clearance, and inside
// the solid.
void wander(const SurfaceMesh& mesh, double radius, int sweeps, int& met) {
  Random random;
  NearTriangles near;
  const double usual = mesh.size() / std::sqrt(static_cast<double>(mesh.triangles().size()));
  Vector3d p = mesh.triangles().front().a + (radius + mesh.clearance()) * Vector3d::UnitX();
  for (int i = 0; i < sweeps; ++i) {
    const double length = usual * std::pow(10.0, 1.0 - random.below(5));
    const Vector3d step = length * random.vector();
    SweepHit by_list;
    SweepHit by_tree;
    const bool found = mesh.sweep(p, step, radius, near, by_list);
    ASSERT_EQ(mesh.sweep(p, step, radius, by_tree), found) << "sweep " << i;
    if (found) {
      ++met;
      ASSERT_EQ(by_list.t, by_tree.t) << "sweep " << i;
      ASSERT_EQ(by_list.normal, by_tree.normal) << "sweep " << i;
      ASSERT_EQ(by_list.triangle, by_tree.triangle) << "sweep " << i;
      ASSERT_EQ(by_list.on_face, by_tree.on_face) << "sweep " << i;
    }
    p += found ? Vector3d(by_list.t * step) : step;
    if (random.below(30) == 0 || !mesh.bounds().contains(0.7 * p)) {
      const auto count = static_cast<int>(mesh.triangles().size());
      const Triangle& t = mesh.triangles()[static_cast<std::size_t>(random.below(count))];
      const double above =
          random.below(3) == 0 ? mesh.clearance() : usual * random.gauss(random.engine);
      p = (t.a + t.b + t.c) / 3.0 + (radius + above) * t.normal;
    }
  }
}

TEST(NearTriangles, GiveTheResultOfTheTree) {
  int met = 0;
  for (const test::MeshData& data :
       {test::torus(48, 24), test::torus(132, 66), test::groove(), test::fin(0.02)}) {
    for (const double size : {1e-3, 0.2, 200.0}) {
      const SurfaceMesh mesh = test::make_mesh(data, size);
      for (const double radius : {0.0, 0.005 * size, 0.1 * size}) {
        SCOPED_TRACE(std::to_string(data.triangles.size()) + " triangles, " + std::to_string(size) +
                     " m, radius " + std::to_string(radius));
        wander(mesh, radius, 800, met);
      }
    }
  }
  EXPECT_GT(met, 6'000);
}

// Strokes with jumps between them.
TEST(NearTriangles, FindTheNearestPoint) {
  Random random;
  for (const double size : {1e-3, 0.2, 200.0}) {
    const SurfaceMesh mesh = test::make_mesh(test::torus(132, 66), size);
    NearTriangles near;
    Vector3d p = Vector3d::Zero();
    for (int i = 0; i < 4000; ++i) {
      p += 3e-4 * size * random.vector();
      if (i % 500 == 0) p = 0.3 * size * random.vector();
      ClosestPoint by_tree;
      ClosestPoint by_list;
      ASSERT_TRUE(mesh.closest(p, 1e9, by_tree));
      ASSERT_TRUE(mesh.closest_near(p, near, by_list));
      ASSERT_EQ(by_list.distance, by_tree.distance) << "point " << i;
    }
  }
}

TEST(ClosestPoint, ErrorIsAtMostThePrecision) {
  Random random;
  const SurfaceMesh mesh = test::make_mesh(test::torus(132, 66), 0.2);
  int rough = 0;
  for (int i = 0; i < 6000; ++i) {
    const Vector3d p = 0.06 * random.vector();
    const double precision = 0.01 * std::pow(0.1, random.below(5));
    ClosestPoint exact;
    ClosestPoint near;
    ASSERT_TRUE(mesh.closest(p, 1.0, exact));
    ASSERT_TRUE(mesh.closest(p, 1.0, near, precision));
    ASSERT_LE(near.distance, exact.distance + precision * (1.0 + 1e-9)) << "point " << i;
    const auto& t = mesh.triangles()[near.triangle];
    ASSERT_EQ(near.point, closest_on_triangle(t, p)) << "point " << i;
    rough += near.distance > exact.distance ? 1 : 0;
    ASSERT_TRUE(mesh.closest_from(p, 0, near, precision));
    ASSERT_LE(near.distance, exact.distance + precision * (1.0 + 1e-9)) << "point " << i;
    // A point within the limit is found at any precision.
    ASSERT_TRUE(mesh.closest(p, exact.distance * (1.0 + 1e-9), near, precision));
  }
  EXPECT_GT(rough, 500);  // the precision is used
}

}  // namespace
}  // namespace reckon::haptics::near_triangles_test
