// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The surface contact point (SCP) on implicit surfaces. RECKON_SOAK=1 pokes a million times.
#include "reckon/haptics/geometry/implicit_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <vector>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/implicit_solids.hpp"
#include "reckon/tests/support/random_point.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::implicit_solid_test {
namespace {

using Eigen::Vector3d;
using test::random_point;
using SolidPointer = std::shared_ptr<const ImplicitSolid>;

constexpr double kTight = 1e-9;  // [m]

template <class ShapeOfIt>
SolidPointer solid(const ShapeOfIt& shape) {
  return std::make_shared<const ImplicitSolid>(shape);
}

struct Pokes {
  long count = 0, touching = 0, unfinished = 0, raised = 0;
  double deepest = 0.0, highest = 0.0;  // [m], of the SCP's f - radius
};

// From outside into the solid, through it, along it and out, in jumps of all lengths.
void poke(const ImplicitSolid& object, const ContactShape& shape, double radius, int rounds,
          Pokes& pokes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  FrictionCone friction(0.5, 0.35);
  const double reach = 0.09 + 2.0 * radius;
  for (int i = 0; i < rounds; ++i) {
    Vector3d device = 2.5 * reach * random_point(random, 1.0).normalized();
    if (object.contains(device, radius + kTight)) continue;
    SurfaceContactPoint point(radius);
    point.reset(shape, device);
    for (int k = 0; k < 10; ++k) {
      const double leap = k % 2 == 0 ? 1.0 : std::pow(10.0, -3.0 * share(random));
      device += leap * (random_point(random, 0.6 * reach) - device);
      const double before = (device - point.scp()).norm();
      point.update(shape, device, i % 2 == 0 ? nullptr : &friction);
      const double above = object.sample(point.scp()).value - radius;
      ++pokes.count;
      pokes.deepest = std::max(pokes.deepest, -above);
      if ((device - point.scp()).norm() > before * (1.0 + 1e-15)) ++pokes.raised;
      if (!point.in_contact()) {
        ASSERT_EQ(point.scp(), device);
        continue;
      }
      ++pokes.touching;
      if (above >= kTight) {  // a jump may need more iterations than one update has: see
                              // kMostLandings
        ++pokes.unfinished;
        point.update(shape, device, i % 2 == 0 ? nullptr : &friction);
      }
      const double rest = std::abs(object.sample(point.scp()).value - radius);
      pokes.highest = std::max(pokes.highest, rest);
    }
  }
}

TEST(ImplicitSolid, NoPokeMovesThePointOffTheSurface) {
  Pokes all;
  for (const test::NamedSolid& named : test::implicit_solids()) {
    for (const double radius : {0.0, 3e-3}) {
      Pokes pokes;
      poke(*named.solid, named.solid, radius, test::tries(60, 4500), pokes);
      const std::string told = named.name + ", radius " + std::to_string(radius);
      EXPECT_LT(pokes.deepest, kTight) << told;
      EXPECT_LT(pokes.highest, kTight) << told;
      EXPECT_LE(pokes.unfinished, pokes.touching / 10'000) << told;
      EXPECT_EQ(pokes.raised, 0) << told;
      EXPECT_GT(pokes.touching, pokes.count / 10) << told;
      all.count += pokes.count;
      all.touching += pokes.touching;
      all.unfinished += pokes.unfinished;
      all.deepest = std::max(all.deepest, pokes.deepest);
      all.highest = std::max(all.highest, pokes.highest);
    }
  }
  std::printf(
      "%ld pokes, %ld touching, %ld of them in two updates: deepest %.2g m, highest %.2g m\n",
      all.count, all.touching, all.unfinished, all.deepest, all.highest);
}

SurfaceContactPoint pressed(const ContactShape& shape, const Vector3d& from, const Vector3d& device,
                            FrictionCone* friction = nullptr, double radius = 0.0) {
  SurfaceContactPoint point(radius);
  point.reset(shape, from);
  point.update(shape, device, friction);
  return point;
}

TEST(ImplicitSolid, HoldsTheContactPointNearestToTheDevice) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const ContactShape cylinder = solid(CylinderShape{0.03, 0.2});
  const ContactShape torus = solid(TorusShape{0.04, 0.015});
  for (const double radius : {0.0, 2e-3}) {
    for (int i = 0; i < 300; ++i) {
      const double turn = 6.28 * share(random);
      const double deep = 0.005 * share(random);
      const Vector3d out(std::cos(turn), std::sin(turn), 0.0);
      const Vector3d along(0.0, 0.0, 0.05 * share(random));
      const Vector3d on_wall = (0.03 + radius) * out + along;
      const SurfaceContactPoint wall =
          pressed(cylinder, 2.0 * on_wall, on_wall - deep * out, nullptr, radius);
      EXPECT_LT((wall.scp() - on_wall).norm(), kTight);
      EXPECT_LT((wall.normal() - out).norm(), 1e-7);

      // Then on from there, around both of its curves.
      const double lift = 6.28 * share(random);
      const Vector3d middle = 0.04 * out;
      const Vector3d steep = std::cos(lift) * out + std::sin(lift) * Vector3d::UnitZ();
      const Vector3d foot = middle + (0.015 + radius) * steep;
      SurfaceContactPoint ring =
          pressed(torus, middle + 0.025 * steep, foot - deep * steep, nullptr, radius);
      EXPECT_LT((ring.scp() - foot).norm(), 2e-7);
      const Vector3d next_out(std::cos(turn + 0.03), std::sin(turn + 0.03), 0.0);
      const Vector3d next_steep =
          std::cos(lift + 0.05) * next_out + std::sin(lift + 0.05) * Vector3d::UnitZ();
      const Vector3d next_foot = 0.04 * next_out + (0.015 + radius) * next_steep;
      ring.update(torus, next_foot - deep * next_steep, nullptr);
      EXPECT_LT((ring.scp() - next_foot).norm(), 1e-6) << deep << " deep";
    }
  }
}

TEST(ImplicitSolid, ThinSolidIsNeverCrossed) {
  using enum CsgOperation;
  for (const double thickness : {1e-3, 1e-5, 1e-7}) {
    const CsgShape shell{
        {test::part(add, SphereShape{0.05}), test::part(subtract, SphereShape{0.05 - thickness})}};
    const CsgShape sheet{{test::part(add, BoxShape{{0.2, 0.2, thickness}})}};
    const ContactShape hollow = solid(shell);
    const ContactShape flat = solid(sheet);
    std::mt19937 random(9);
    SurfaceContactPoint outside;
    SurfaceContactPoint above;
    outside.reset(hollow, {0.0, 0.0, 0.1});
    above.reset(flat, {0.0, 0.0, 0.1});
    for (int i = 0; i < 2000; ++i) {
      outside.update(hollow, random_point(random, 0.08), nullptr);
      ASSERT_GE(outside.scp().norm(), 0.05) << thickness << ", " << i;
      const Vector3d under = random_point(random, 0.09);
      above.update(flat, {under.x(), under.y(), -std::abs(under.z())}, nullptr);
      ASSERT_GE(above.scp().z(), 0.5 * thickness) << thickness << ", " << i;
    }
  }
}

// A hand at rest in a concave edge, then in the corner of three blocks: at once the SCP is at the
// intersection of the two or three planes, and it stays there to the bit.
TEST(ImplicitSolid, RestsInConcaveEdgesAndCorners) {
  using enum CsgOperation;
  const ContactShape edge = solid(test::step_shape(0.0));
  SurfaceContactPoint point;
  point.reset(edge, {0.05, 0.0, 0.05});
  for (const Vector3d& device : {Vector3d(-0.004, 0.01, -0.003), Vector3d(-0.001, 0.02, -0.009)}) {
    point.update(edge, device, nullptr);
    EXPECT_LT((point.scp() - Vector3d(0.0, device.y(), 0.0)).norm(), 2.0 * kTight);
    const Vector3d rest = point.scp();
    for (int i = 0; i < 1000; ++i) {
      point.update(edge, device, nullptr);
      ASSERT_EQ(point.scp(), rest) << "tick " << i;
    }
  }
  CsgShape room = test::step_shape(0.0);
  room.parts.push_back(test::part(add, BoxShape{{0.2, 0.02, 0.1}}, {0.0, 0.05, 0.0}));
  const ContactShape corner = solid(room);
  point.reset(corner, {0.03, 0.0, 0.03});
  const Vector3d device(-0.004, 0.046, -0.003);
  point.update(corner, device, nullptr);
  EXPECT_LT((point.scp() - Vector3d(0.0, 0.04, 0.0)).norm(), 2.0 * kTight);
  const Vector3d rest = point.scp();
  for (int i = 0; i < 1000; ++i) {
    point.update(corner, device, nullptr);
    ASSERT_EQ(point.scp(), rest) << "tick " << i;
  }
}

// Around a fillet without a jump: a motion of the device by 10 um moves the SCP by at most a few
// times that.
TEST(ImplicitSolid, FollowsAFilletWithoutAJump) {
  const auto step = solid(test::step_shape(0.01));
  const ContactShape shape = step;
  SurfaceContactPoint point;
  point.reset(shape, {0.03, 0.0, 0.01});
  Vector3d before = Vector3d::Zero();
  for (int i = 0; i <= 4000; ++i) {
    const double x = 0.03 - 1e-5 * i;
    point.update(shape, {std::max(x, -0.002), 0.0, x < -0.002 ? -0.002 - x - 0.002 : -0.002},
                 nullptr);
    ASSERT_TRUE(point.in_contact());
    ASSERT_LT(std::abs(step->sample(point.scp()).value), kTight);
    if (i > 0) {
      ASSERT_LT((point.scp() - before).norm(), 1e-4) << "x " << x;
    }
    before = point.scp();
  }
}

TEST(ImplicitSolid, SticksWithoutDriftThenSlides) {
  const ContactShape cylinder = solid(CylinderShape{0.03, 0.2});
  FrictionCone friction(0.5, 0.35);
  SurfaceContactPoint point = pressed(cylinder, {0.05, 0.0, 0.0}, {0.028, 0.0, 0.0}, &friction);
  const Vector3d rest = point.scp();
  double z = 0.0;
  for (; z < 0.00099; z += 1e-6) {  // below 0.5 x 2 mm
    point.update(cylinder, {0.028, 0.0, z}, &friction);
    ASSERT_EQ(point.scp(), rest) << z;
  }
  z = 0.00101;
  point.update(cylinder, {0.028, 0.0, z}, &friction);
  EXPECT_NEAR(z - point.scp().z(), 0.35 * 0.002, 2.0 * kTight);
  for (int i = 0; i < 100; ++i) {
    z += 1e-6;
    point.update(cylinder, {0.028, 0.0, z}, &friction);
    ASSERT_NEAR(z - point.scp().z(), 0.35 * 0.002, 2.0 * kTight);
  }
}

// A ring on a floor: the hand moves down beside it, into the concave edge all around.
TEST(ImplicitSolid, SharesTheContactPointWithOtherObjects) {
  Scene scene;
  scene.objects.resize(2);
  scene.objects[0] = {"floor", PlaneShape{}, {}, {}, {}};
  scene.objects[1] = {"ring", CylinderShape{0.03, 0.05}, {{0.0, 0.0, 0.025}}, {}, {}};
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  solver.reset({0.06, 0.0, 0.03});
  for (int i = 0; i <= 600; ++i) {
    const double turn = 0.01 * i;
    const Vector3d out(std::cos(turn), std::sin(turn), 0.0);
    const ContactResult result = solver.step(0.028 * out - 0.003 * Vector3d::UnitZ());
    if (i == 0) continue;  // it came over the floor
    ASSERT_EQ(result.touched.size(), 2u) << i;
    ASSERT_LT((result.scp - 0.03 * out).norm(), 1e-6) << i;
    ASSERT_GE(result.scp.head<2>().norm(), 0.03);
    ASSERT_GE(result.scp.z(), 0.0);
  }
}

TEST(ImplicitSolid, StartsOutsideOfASolidAroundIt) {
  std::mt19937 random(5);
  for (const test::NamedSolid& named : test::implicit_solids()) {
    const ContactShape shape = named.solid;
    for (int i = 0; i < 200; ++i) {
      const Vector3d device = i == 0 ? Vector3d::Zero() : random_point(random, 0.06);
      SurfaceContactPoint point(1e-3);
      const bool was_inside = point.reset(shape, device);
      EXPECT_EQ(was_inside, named.solid->sample(device).value < 0.0) << named.name;
      EXPECT_GE(named.solid->sample(point.scp()).value, 1e-3) << named.name;
    }
  }
}

TEST(ImplicitSolid, NeedsNoHeapInAnUpdate) {
  const ContactShape shape = solid(test::bracket_shape(0.004));
  SurfaceContactPoint point;
  point.reset(shape, {0.0, 0.0, 0.2});
  const test::AllocationGuard guard;
  point.update(shape, {0.02, 0.01, 0.0}, nullptr);
  point.update(shape, {0.03, 0.0, 0.005}, nullptr);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(ImplicitSolid, RefusesInvalidDimensions) {
  using enum CsgOperation;
  EXPECT_THROW(ImplicitSolid(CylinderShape{0.0, 0.1}), std::invalid_argument);
  EXPECT_THROW(ImplicitSolid(ConeShape{0.0, 0.0, 0.1}), std::invalid_argument);
  EXPECT_THROW(ImplicitSolid(TorusShape{0.01, 0.02}), std::invalid_argument);
  EXPECT_THROW(ImplicitSolid(EllipsoidShape{{0.01, 0.0, 0.02}}), std::invalid_argument);
  EXPECT_THROW(ImplicitSolid(CsgShape{}), std::invalid_argument);
  EXPECT_THROW(ImplicitSolid(CsgShape{{test::part(subtract, SphereShape{0.05})}}),
               std::invalid_argument);
  EXPECT_THROW(ImplicitSolid(CsgShape{{test::part(add, SphereShape{0.05}),
                                       test::part(intersect, SphereShape{0.05}, {1.0, 0.0, 0.0})}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics::implicit_solid_test
