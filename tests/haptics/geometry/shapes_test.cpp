// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/shapes.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "reckon/tests/support/random_point.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::random_point;

// A path about the origin in small steps, with a jump now and then.
class Wander {
 public:
  Wander(double reach, std::uint32_t seed) : reach_(reach), random_(seed) {}
  Vector3d next() {
    if (++count_ % 200 == 0) return at_ = random_point(random_, reach_);
    at_ += random_point(random_, 0.02 * reach_);
    return at_ = at_.cwiseMax(-reach_).cwiseMin(reach_);
  }

 private:
  double reach_;
  std::mt19937 random_;
  Vector3d at_ = Vector3d::Zero();
  int count_ = 0;
};

// Follows a path; no update may increase the distance, and the SCP must not be inside.
template <class Solid>
void expect_invariants(const Solid& solid, double reach, FrictionCone* friction) {
  Wander wander(reach, 5);
  Vector3d scp = Vector3d::Constant(2.0 * reach);
  int contacts = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d device = wander.next();
    const double before = (device - scp).norm();
    const SettledPoint point = solid.settle(scp, device, friction);
    scp = point.scp;
    contacts += point.in_contact ? 1 : 0;
    ASSERT_LE((device - scp).norm(), before * (1.0 + 1e-15) + 1e-17) << "tick " << i;
    ASSERT_FALSE(solid.contains(scp * (1.0 + 1e-14))) << "tick " << i;
  }
  EXPECT_GT(contacts, 1000);
}

TEST(HalfSpace, PutsTheContactPointNearestToTheDevice) {
  const HalfSpace plane(PlaneShape{Vector3d(0.0, 3.0, 4.0)});
  const Vector3d n(0.0, 0.6, 0.8);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d device = random_point(random, 1.0);
    const SettledPoint point = plane.settle(n, device, nullptr);
    const double depth = -n.dot(device);
    ASSERT_EQ(point.in_contact, depth > 0.0);
    const Vector3d expected = depth > 0.0 ? Vector3d(device + depth * n) : device;
    ASSERT_LT((point.scp - expected).norm(), 1e-15);
  }
}

TEST(HalfSpace, SticksWithoutDriftThenSlides) {
  const HalfSpace plane(PlaneShape{});
  FrictionCone friction(0.5, 0.35);
  Vector3d scp = plane.settle({0.0, 0.0, 1.0}, {0.0, 0.0, -0.002}, &friction).scp;
  const Vector3d rest = scp;
  double x = 0.0;
  for (; x < 0.00099; x += 1e-6) {  // below 0.5 x 2 mm
    scp = plane.settle(scp, {x, 0.0, -0.002}, &friction).scp;
    ASSERT_EQ(scp, rest) << "at lateral " << x;
  }
  x = 0.00101;
  scp = plane.settle(scp, {x, 0.0, -0.002}, &friction).scp;
  EXPECT_NEAR(x - scp.x(), 0.35 * 0.002, 1e-15);
  for (int i = 0; i < 100; ++i) {
    x += 1e-6;
    scp = plane.settle(scp, {x, 0.0, -0.002}, &friction).scp;
    ASSERT_NEAR(x - scp.x(), 0.35 * 0.002, 1e-15) << "sliding goes on at the kinetic share";
  }
  scp = plane.settle(scp, {x, 0.0, -0.002}, &friction).scp;  // a resting hand: the point rests
                                                             // again
  const Vector3d second = scp;
  scp = plane.settle(scp, {x + 0.0002, 0.0, -0.002}, &friction).scp;
  EXPECT_EQ(scp, second) << "0.9 mm is below the static share again";
}

TEST(HalfSpace, GivesNoFrictionWithoutNormalForce) {
  const HalfSpace plane(PlaneShape{});
  FrictionCone friction(10.0, 10.0);
  const Vector3d device(0.01, 0.0, 0.0);
  const SettledPoint point = plane.settle(Vector3d::Zero(), device, &friction);
  EXPECT_EQ(point.scp, device);
  EXPECT_FALSE(point.in_contact);
}

TEST(Ball, PutsTheContactPointOnTheDevicesRadius) {
  const Ball ball(SphereShape{0.05});
  Wander wander(0.08, 2);
  Vector3d scp(0.0, 0.0, 0.2);
  for (int i = 0; i < 20000; ++i) {
    const Vector3d device = wander.next();
    const SettledPoint point = ball.settle(scp, device, nullptr);
    scp = point.scp;
    const bool inside = device.norm() < 0.05;
    const Vector3d expected = inside ? Vector3d(0.05 * device.normalized()) : device;
    ASSERT_LT((scp - expected).norm(), 1e-15) << device.transpose();
    ASSERT_EQ(point.in_contact, inside);
  }
}

TEST(Ball, SlidesToTheKineticShareOfNormalForce) {
  const Ball ball(SphereShape{0.05});
  std::mt19937 random(3);
  int slides = 0;
  for (int i = 0; i < 2000; ++i) {
    FrictionCone friction(0.6, 0.4);
    const Vector3d start = 0.05 * random_point(random, 1.0).normalized();
    const Vector3d device = random_point(random, 0.028);
    const SettledPoint point = ball.settle(1.001 * start, device, &friction);
    ASSERT_TRUE(point.in_contact);
    const Vector3d spring = device - point.scp;
    const double normal = -spring.dot(point.normal);
    const double lateral = (spring + normal * point.normal).norm();
    if (friction.sliding()) {
      ++slides;
      ASSERT_NEAR(lateral, 0.4 * normal, 1e-14);
    } else {
      ASSERT_LE(lateral, 0.6 * normal + 1e-15);
    }
  }
  EXPECT_GT(slides, 500);
}

TEST(Block, PutsTheContactPointOnTheEntryFace) {
  const Block block(BoxShape{Vector3d(0.1, 0.2, 0.3)});
  const double clearance = kRelativeClearance * Vector3d(0.1, 0.2, 0.3).norm();
  const Vector3d from(0.2, 0.02, 0.01);
  const SettledPoint point = block.settle(from, {-0.01, 0.05, -0.04}, nullptr);
  EXPECT_TRUE(point.in_contact);
  EXPECT_LT((point.scp - Vector3d(0.05 + clearance, 0.05, -0.04)).norm(), 1e-15);
  EXPECT_EQ(point.normal, Vector3d::UnitX());
}

TEST(Block, HoldsADeviceThatPassedThrough) {
  const Block block(BoxShape{Vector3d(0.001, 0.2, 0.2)});
  const SettledPoint point = block.settle({0.01, 0.0, 0.0}, {-0.01, 0.03, 0.0}, nullptr);
  EXPECT_TRUE(point.in_contact);
  EXPECT_NEAR(point.scp.x(), 0.0005, 1e-7);
  // Beyond its border the device is free again, on the other side.
  const SettledPoint around = block.settle(point.scp, {-0.01, 0.11, 0.0}, nullptr);
  EXPECT_FALSE(around.in_contact);
}

TEST(Shapes, NeverIncreaseDistanceOrEnterTheSolid) {
  for (const bool rough : {false, true}) {
    FrictionCone friction(0.8, 0.3);
    FrictionCone* used = rough ? &friction : nullptr;
    expect_invariants(Ball(SphereShape{0.05}), 0.07, used);
    expect_invariants(Block(BoxShape{Vector3d(0.1, 0.05, 0.08)}), 0.07, used);
  }
}

TEST(Shapes, RefuseInvalidDimensions) {
  EXPECT_THROW(HalfSpace(PlaneShape{Vector3d::Zero()}), std::invalid_argument);
  EXPECT_THROW(Ball(SphereShape{0.0}), std::invalid_argument);
  EXPECT_THROW(Ball(SphereShape{std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
  EXPECT_THROW(Block(BoxShape{Vector3d(0.1, -0.1, 0.1)}), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics
