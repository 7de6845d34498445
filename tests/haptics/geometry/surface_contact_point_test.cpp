// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/surface_contact_point.hpp"

#include <gtest/gtest.h>

#include <random>

#include "reckon/haptics/geometry/constraint_planes.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/random_point.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::random_point;

ContactShape shared(const test::MeshData& data, double size) {
  return std::make_shared<const SurfaceMesh>(test::make_mesh(data, size));
}

const SurfaceMesh& mesh_of(const ContactShape& shape) {
  return *std::get<std::shared_ptr<const SurfaceMesh>>(shape);
}

struct NamedMesh {
  const char* name;
  test::MeshData data;
};

std::vector<NamedMesh> hard_meshes() {
  return {{"cube", test::cube()},
          {"torus", test::torus(48, 24)},
          {"groove", test::groove()},
          {"fin", test::fin(0.01)},
          {"blade", test::fin(1e-4)}};
}

// Invariants after every update, for any motion of the device.
void expect_outside(const SurfaceMesh& mesh, const SurfaceContactPoint& point) {
  ASSERT_LT(test::winding_number(mesh, point.scp()), 0.5) << "popped through";
  ClosestPoint nearest;
  ASSERT_TRUE(mesh.closest(point.scp(), 1e9, nearest));
  if (!point.in_contact()) return;
  ASSERT_GE(nearest.distance, 0.5 * mesh.clearance());
  ASSERT_LE(nearest.distance, 5e-7 * mesh.size()) << "gap, 0.1 um on 0.2 m";
}

TEST(SurfaceContactPoint, StaysOutsideAndSettledAtEveryScale) {
  for (const NamedMesh& named : hard_meshes()) {
    for (const double size : {1e-3, 0.2, 10.0}) {
      for (const bool rough : {false, true}) {
        SCOPED_TRACE(testing::Message()
                     << named.name << " of " << size << " m, friction " << rough);
        const ContactShape shape = shared(named.data, size);
        FrictionCone friction(0.5, 0.35);
        SurfaceContactPoint point;
        test::Stroke stroke(mesh_of(shape), 1.5e-3 * size, 0.01 * size, 11);
        point.reset(shape, stroke.start());
        for (int i = 0; i < 1000; ++i) {
          const Vector3d device = stroke.next();
          const double before = (device - point.scp()).norm();
          point.update(shape, device, rough ? &friction : nullptr);
          ASSERT_LE((device - point.scp()).norm(), before) << "tick " << i;
          if (i % 5 == 0) {
            ASSERT_NO_FATAL_FAILURE(expect_outside(mesh_of(shape), point)) << "tick " << i;
          }
          const Vector3d settled = point.scp();
          point.update(shape, device, rough ? &friction : nullptr);
          ASSERT_LE((point.scp() - settled).norm(), 5e-7 * size)
              << "lag, 0.1 um on 0.2 m, tick " << i;
        }
      }
    }
  }
}

TEST(SurfaceContactPoint, KeepsItsInvariantsWhenTheDeviceJumps) {
  std::mt19937 random(21);
  for (const NamedMesh& named : hard_meshes()) {
    SCOPED_TRACE(named.name);
    const ContactShape shape = shared(named.data, 0.2);
    for (const bool rough : {false, true}) {
      FrictionCone friction(0.5, 0.35);
      SurfaceContactPoint point;
      point.reset(shape, Vector3d(0.3, 0.1, 0.2));
      for (int i = 0; i < 1500; ++i) {
        const double reach = i % 50 == 0 ? 1e4 : 0.15;
        const Vector3d device = random_point(random, reach);
        const double before = (device - point.scp()).norm();
        point.update(shape, device, rough ? &friction : nullptr);
        ASSERT_LE((device - point.scp()).norm(), before) << "tick " << i;
        if (i % 5 == 0) {
          ASSERT_NO_FATAL_FAILURE(expect_outside(mesh_of(shape), point)) << "tick " << i;
        }
      }
    }
  }
}

TEST(SurfaceContactPoint, NeverPassesThroughAThinBlade) {
  // The blade's whole thickness is a few clearances; the device moves far beyond it.
  for (const double thickness : {1e-2, 1e-4, 3e-6}) {
    const ContactShape shape = shared(test::fin(thickness), 0.2);
    SurfaceContactPoint point;
    point.reset(shape, Vector3d(0.01, 0.0, 0.0));
    for (double x = 0.01; x > -0.05; x -= 1e-5) {
      const Vector3d device(x, 0.3 * (0.01 - x), 0.2 * (x - 0.01));
      point.update(shape, device, nullptr);
      ASSERT_GT(point.scp().x(), 0.0) << "thickness " << thickness << " x " << x;
    }
    EXPECT_TRUE(point.in_contact());
  }
}

TEST(SurfaceContactPoint, HoldsOnBothSidesOfAnOpenSheet) {
  test::MeshData sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.quad(0, 1, 2, 3);
  const ContactShape shape = shared(sheet, 0.2);
  for (const double side : {1.0, -1.0}) {
    SurfaceContactPoint point;
    EXPECT_FALSE(point.reset(shape, Vector3d(0.0, 0.0, 0.01 * side)));
    point.update(shape, Vector3d(0.01, 0.0, -0.02 * side), nullptr);
    EXPECT_TRUE(point.in_contact());
    EXPECT_NEAR(point.scp().z(), side * mesh_of(shape).clearance(), 1e-12);
    EXPECT_GT(point.normal().z() * side, 0.999);
    // Around the border it reaches the device.
    point.update(shape, Vector3d(0.2, 0.0, -0.02 * side), nullptr);
    EXPECT_FALSE(point.in_contact());
  }
}

TEST(SurfaceContactPoint, SettlesInCornersWithinATick) {
  // Inside a hollow cube the allowed points are a box: the nearest one is a clamp.
  const ContactShape shape = shared(test::cube(), 0.2);
  const double half = 0.5 * mesh_of(shape).bounds().sizes().x() - mesh_of(shape).clearance();
  std::mt19937 random(4);
  int corners = 0;
  SurfaceContactPoint point;
  point.set_free(Vector3d::Zero());
  for (int i = 0; i < 3000; ++i) {
    const Vector3d device = random_point(random, 2.0 * half);
    point.update(shape, device, nullptr);
    const Vector3d expected = device.cwiseMax(-half).cwiseMin(half);
    corners += (device.cwiseAbs().array() > half).count() >= 2 ? 1 : 0;
    ASSERT_LT((point.scp() - expected).norm(), 1e-9) << "tick " << i;
  }
  EXPECT_GT(corners, 1000);
}

TEST(SurfaceContactPoint, OnABoxMeshMatchesTheClosedForm) {
  const ContactShape mesh = shared(test::cube(), 0.2);
  const Vector3d sizes = mesh_of(mesh).bounds().sizes();
  const ContactShape block = Block(BoxShape{sizes});
  std::mt19937 random(13);
  for (const bool rough : {false, true}) {
    FrictionCone mesh_friction(0.5, 0.35);
    FrictionCone block_friction(0.5, 0.35);
    SurfaceContactPoint on_mesh;
    SurfaceContactPoint on_block;
    on_mesh.set_free(Vector3d(0.0, 0.0, 0.2));
    on_block.set_free(Vector3d(0.0, 0.0, 0.2));
    Vector3d device(0.0, 0.0, 0.2);
    int contacts = 0;
    for (int i = 0; i < 20000; ++i) {
      device = 0.995 * device + random_point(random, 0.01);
      on_mesh.update(mesh, device, rough ? &mesh_friction : nullptr);
      on_block.update(block, device, rough ? &block_friction : nullptr);
      ASSERT_EQ(on_mesh.in_contact(), on_block.in_contact()) << "tick " << i;
      ASSERT_LT((on_mesh.scp() - on_block.scp()).norm(), 1e-6 * 0.2) << "tick " << i;
      contacts += on_mesh.in_contact() ? 1 : 0;
    }
    EXPECT_GT(contacts, 1000);
  }
}

// Hildreth's method: cyclic projection with memory, to convergence.
Vector3d hildreth(const std::vector<ConstraintPlane>& planes, const Vector3d& device) {
  std::vector<double> load(planes.size(), 0.0);
  Vector3d x = device;
  for (int round = 0; round < 5000; ++round) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double change = std::max(planes[i].level - planes[i].normal.dot(x), -load[i]);
      load[i] += change;
      x += change * planes[i].normal;
    }
  }
  return x;
}

TEST(ConstraintPlanes, SolutionEqualsAnIndependentMethod) {
  std::mt19937 random(9);
  std::array<int, 4> by_active{};
  for (int i = 0; i < 400; ++i) {
    const std::size_t count = 1 + static_cast<std::size_t>(i) % 5;
    std::vector<ConstraintPlane> planes;
    ConstraintPlanes solver;
    for (std::size_t k = 0; k < count; ++k) {
      ConstraintPlane plane{};
      plane.normal = (random_point(random, 1.0) + Vector3d(0.0, 0.0, 1.5)).normalized();
      plane.level = 0.1 * random_point(random, 1.0).x();
      planes.push_back(plane);
      solver.add(plane, Vector3d(0, 0, 10));
    }
    const Vector3d device = random_point(random, 1.0);
    ConstraintSolution solution;
    ASSERT_TRUE(solver.solve(device, 1e-12, solution));
    ++by_active[solution.active_count];
    ASSERT_LT((solution.point - hildreth(planes, device)).norm(), 1e-6) << "case " << i;
    ASSERT_LT((solution.point - device - solution.push).norm(), 1e-12);
  }
  for (const int seen : by_active) EXPECT_GT(seen, 2) << "each number of active planes occurs";
}

TEST(SurfaceContactPoint, SticksWithoutDriftUpToTheStaticShare) {
  const ContactShape shape = shared(test::cube(), 0.2);
  const double top = mesh_of(shape).bounds().max().z() + mesh_of(shape).clearance();
  FrictionCone friction(0.5, 0.35);
  SurfaceContactPoint point;
  point.reset(shape, Vector3d(0.003, 0.002, top + 0.01));
  point.update(shape, Vector3d(0.003, 0.002, top - 0.002), &friction);
  const Vector3d rest = point.scp();
  for (int i = 0; i < 100000; ++i) {  // 0.99 mm in all directions, for 100 s
    const double angle = 1e-3 * i;
    const Vector3d lateral(0.00099 * std::cos(angle), 0.00099 * std::sin(angle), 0.0);
    point.update(shape, Vector3d(0.003, 0.002, top - 0.002) + lateral, &friction);
    ASSERT_EQ(point.scp(), rest) << "drift at tick " << i;
  }
  point.update(shape, Vector3d(0.003 + 0.00101, 0.002, top - 0.002), &friction);
  const Vector3d slid = point.scp() - rest;
  EXPECT_NEAR(slid.x(), 0.00101 - 0.35 * 0.002, 1e-9);
  EXPECT_NEAR(slid.y(), 0.0, 1e-12);
  EXPECT_TRUE(friction.sliding());
}

TEST(SurfaceContactPoint, ForceStaysInTheFrictionConeWhileStroking) {
  const ContactShape shape = shared(test::torus(72, 36), 0.2);
  FrictionCone friction(0.5, 0.35);
  SurfaceContactPoint point;
  test::Stroke stroke(mesh_of(shape), 1e-4, 2e-3, 3);
  point.reset(shape, stroke.start());
  for (int i = 0; i < 20000; ++i) {
    const Vector3d device = stroke.next();
    point.update(shape, device, &friction);
    if (!point.in_contact()) continue;
    const Vector3d spring = point.scp() - device;
    const double normal = spring.dot(point.normal());
    const double lateral = (spring - normal * point.normal()).norm();
    ASSERT_LE(lateral, 0.5 * normal * 1.001 + 1e-9) << "tick " << i;
  }
}

TEST(SurfaceContactPoint, StartsAtTheNearestOutsidePoint) {
  std::mt19937 random(6);
  for (const NamedMesh& named : hard_meshes()) {
    SCOPED_TRACE(named.name);
    const ContactShape shape = shared(named.data, 0.2);
    const SurfaceMesh& mesh = mesh_of(shape);
    int inside = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3d device =
          mesh.bounds().center() + random_point(random, 0.5).cwiseProduct(mesh.bounds().sizes());
      SurfaceContactPoint point;
      const bool started_inside = point.reset(shape, device);
      ASSERT_EQ(started_inside, test::winding_number(mesh, device) > 0.5);
      ASSERT_LT(test::winding_number(mesh, point.scp()), 0.5);
      if (!started_inside) continue;
      ++inside;
      ClosestPoint nearest;
      ASSERT_TRUE(mesh.closest(device, mesh.size(), nearest));
      ASSERT_LT((point.scp() - nearest.point).norm(), 1e-5 * mesh.size());
      point.update(shape, device, nullptr);
      ASSERT_TRUE(point.in_contact());
      ASSERT_NO_FATAL_FAILURE(expect_outside(mesh, point));
    }
    EXPECT_GT(inside, 20);
  }
}

TEST(SurfaceContactPoint, AllocatesNothing) {
  const ContactShape shape = shared(test::torus(72, 36), 0.2);
  FrictionCone friction(0.5, 0.35);
  SurfaceContactPoint point;
  test::Stroke stroke(mesh_of(shape), 5e-4, 2e-3, 3);
  const Vector3d start = stroke.start();
  const test::AllocationGuard guard;
  point.reset(shape, start);
  for (int i = 0; i < 2000; ++i) point.update(shape, stroke.next(), i % 2 ? &friction : nullptr);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
