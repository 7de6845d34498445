// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A probe with a radius: its centre keeps that distance from everything that it touches.
// RECKON_SOAK=1 pokes a million times, with meshes of up to a million triangles: some ten minutes
// on one core.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using MeshPointer = std::shared_ptr<const SurfaceMesh>;

Vector3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> any;
  return Vector3d(any(random), any(random), any(random)).normalized();
}

struct Subject {
  const char* name;
  test::MeshData data;
};

std::vector<Subject> subjects() {
  if (test::soaks()) {
    return {{"torus of 5 k", test::torus(72, 36)},
            {"torus of 70 k", test::torus(264, 132)},
            {"torus of 1 M", test::torus(1000, 500)}};
  }
  return {{"torus", test::torus(40, 20)}, {"cube", test::cube()}, {"groove", test::groove()}};
}

// Whether p is inside, if affordable by a method that shares no code with the library.
bool inside(const SurfaceMesh& mesh, const Vector3d& p) {
  return test::soaks() ? mesh.contains(p) : test::winding_number(mesh, p) > 0.5;
}

// From outside into the solid and out on another side, in a few jumps.
int pokes_that_pop(const MeshPointer& mesh, double radius, int pokes) {
  const ContactShape shape = mesh;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  FrictionCone friction(0.5, 0.35);
  int popped = 0;
  for (int i = 0; i < pokes; ++i) {
    const Vector3d start = (0.6 * mesh->size() + 1.5 * radius) * random_direction(random);
    const Vector3d target =
        mesh->bounds().sizes().cwiseProduct(Vector3d(share(random), share(random), share(random)));
    SurfaceContactPoint point(radius);
    point.reset(shape, start);
    for (const double t : {0.5, 0.9, 1.0, 1.02, 0.97, 1.0}) {
      const Vector3d device = start + t * (target - start);
      const double before = (device - point.scp()).norm();
      point.update(shape, device, i % 2 == 0 ? nullptr : &friction);
      if ((device - point.scp()).norm() > before * (1.0 + 1e-15)) ++popped;
    }
    ClosestPoint nearest;
    const bool near = mesh->closest(point.scp(), radius + 0.4 * mesh->clearance(), nearest);
    if (near || inside(*mesh, point.scp())) ++popped;
  }
  return popped;
}

// A ball as large as a fine mesh rolls over thousands of its triangles in each jump, in
// milliseconds to seconds: such rows get as many pokes as fit into a few minutes.
int soak_pokes(std::size_t triangles, double size, double radius) {
  if (radius < size) return 66'000;
  return triangles < 10'000 ? 20'000 : triangles < 100'000 ? 1'500 : 60;
}

TEST(ProbeRadius, NoPokePopsThroughAnyMesh) {
  long pokes = 0;
  for (const Subject& subject : subjects()) {
    for (const double size : {1e-3, 0.2, 200.0}) {
      const auto mesh = std::make_shared<const SurfaceMesh>(test::make_mesh(subject.data, size));
      for (const double radius : {0.0, 1e-3}) {
        const int count = test::soaks() ? soak_pokes(mesh->triangles().size(), size, radius) : 150;
        EXPECT_EQ(pokes_that_pop(mesh, radius, count), 0)
            << subject.name << " of " << size << " m, radius " << radius;
        pokes += count;
      }
    }
  }
  std::printf("%ld pokes\n", pokes);
}

TEST(ProbeRadius, CentreKeepsItsRadiusWhileStroking) {
  for (const test::MeshData& data : {test::torus(48, 24), test::groove()}) {
    for (const double radius : {1e-3, 5e-3}) {
      for (const bool rough : {false, true}) {
        const auto mesh = std::make_shared<const SurfaceMesh>(test::make_mesh(data, 0.2));
        const ContactShape shape = mesh;
        FrictionCone friction(0.5, 0.35);
        SurfaceContactPoint point(radius);
        test::Stroke stroke(*mesh, 3e-4, 1e-3, 11);
        point.reset(shape, stroke.start());
        int touching = 0;
        for (int i = 0; i < 800; ++i) {
          const Vector3d device = stroke.next();
          const double before = (device - point.scp()).norm();
          point.update(shape, device, rough ? &friction : nullptr);
          ASSERT_LE((device - point.scp()).norm(), before) << "tick " << i;
          double distance = 1.0;
          for (const Triangle& t : mesh->triangles()) {
            distance =
                std::min(distance, (closest_on_triangle(t, point.scp()) - point.scp()).norm());
          }
          ASSERT_GE(distance, radius + 0.5 * mesh->clearance()) << "tick " << i;
          if (point.in_contact()) {
            ++touching;
            ASSERT_LE(distance, radius + 1e-7) << "hovers, tick " << i;
          }
          const Vector3d settled = point.scp();
          point.update(shape, device, rough ? &friction : nullptr);
          ASSERT_LE((point.scp() - settled).norm(), 1e-7) << "lags, tick " << i;
        }
        EXPECT_GT(touching, 600);
      }
    }
  }
}

// A ball of 5 mm over the edges of a cube mesh and over a box: the offset surface is rounded.
TEST(ProbeRadius, FindsTheRoundedOffsetOfBoxAndMesh) {
  constexpr double kRadius = 5e-3;
  const auto mesh = std::make_shared<const SurfaceMesh>(test::make_mesh(test::cube(), 0.2));
  const Vector3d half = 0.5 * mesh->bounds().sizes();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1.3, 1.3);
  for (const ContactShape& shape : {ContactShape(mesh), ContactShape(Block({2.0 * half}))}) {
    SurfaceContactPoint point(kRadius);
    point.reset(shape, {0.0, 0.0, 0.2});
    int touching = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d device = half.cwiseProduct(Vector3d(any(random), any(random), any(random)));
      point.update(shape, device, nullptr);
      const double distance = (point.scp().cwiseAbs() - half).cwiseMax(0.0).norm();
      ASSERT_GE(distance, kRadius) << "tick " << i;
      if (!point.in_contact()) {
        ASSERT_EQ(point.scp(), device);
        continue;
      }
      ++touching;
      ASSERT_LE(distance, kRadius + 1e-7) << "tick " << i;
    }
    EXPECT_GT(touching, 500);
  }
}

TEST(ProbeRadius, LiftsPlanesAndEnlargesBalls) {
  SurfaceContactPoint point(2e-3);
  const ContactShape plane = HalfSpace({Vector3d::UnitZ()});
  point.reset(plane, {0.0, 0.0, 0.01});
  point.update(plane, {0.001, 0.0, 0.001}, nullptr);
  EXPECT_NEAR(point.scp().z(), 2e-3, 1e-15);
  const ContactShape ball = Ball({0.05});
  point.reset(ball, {0.0, 0.0, 0.1});
  point.update(ball, {0.0, 0.01, 0.03}, nullptr);
  EXPECT_NEAR(point.scp().norm(), 0.052, 1e-15);
  EXPECT_NEAR(point.scp().cross(Vector3d(0.0, 0.01, 0.03)).norm(), 0.0, 1e-15);
}

TEST(ProbeRadius, StartsClearOfAnOverlappingMesh) {
  const auto mesh = std::make_shared<const SurfaceMesh>(test::make_mesh(test::groove(), 0.2));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-0.6, 0.6);
  for (int i = 0; i < 300; ++i) {
    const Vector3d device =
        mesh->bounds().sizes().cwiseProduct(Vector3d(any(random), any(random), any(random)));
    SurfaceContactPoint point(3e-3);
    point.reset(mesh, device);
    ClosestPoint nearest;
    ASSERT_FALSE(mesh->closest(point.scp(), 3e-3, nearest)) << "start " << i;
    ASSERT_LT(test::winding_number(*mesh, point.scp()), 0.5) << "start " << i;
  }
}

}  // namespace
}  // namespace reckon::haptics
