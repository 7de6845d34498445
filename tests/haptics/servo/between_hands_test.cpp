// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Objects that separate two hands: solids between them, but not beside them.
#include "reckon/haptics/servo/between_hands.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

Scene scene_of(const Shape& shape, double mass) {
  Scene scene;
  SceneObject& object = scene.objects.emplace_back();
  object.name = "thing";
  object.shape = shape;
  object.matter.mass = mass;
  return scene;
}

// The same for a fixed object and for a body that is away from its start.
void expect(bool is, const Shape& shape, const Vector3d& from, const Vector3d& to,
            bool apart = false) {
  const EffectPlan standing(scene_of(shape, 0.0)), moving(scene_of(shape, 0.1));
  EXPECT_EQ(is_between_hands(standing, {}, from, to, apart), is);
  BodyState body;
  body.position = {3, -2, 1};
  body.orientation = Eigen::AngleAxisd(1.0, Vector3d(1, 2, 2) / 3);
  const auto there = [&](const Vector3d& p) -> Vector3d {
    return body.orientation * p + body.position;
  };
  EXPECT_EQ(is_between_hands(moving, {&body, 1}, there(from), there(to), apart), is);
  EXPECT_FALSE(is_between_hands(moving, {&body, 1}, from, to, apart)) << "it has gone";
}

TEST(BetweenHands, CubeSeparatesOppositeFingers) {
  for (const double edge : {0.001, 0.02, 0.03, 0.04, 0.2}) {
    const Vector3d at(0.5 * edge + 1e-9, 0.1 * edge, 0);
    expect(true, BoxShape{Vector3d::Constant(edge)}, at, -at);
    expect(true, BoxShape{Vector3d::Constant(edge)}, at + Vector3d(0.01, 0, 0), -at);
  }
}

TEST(BetweenHands, BoardAndBallSeparateOppositeHands) {
  expect(true, BoxShape{Vector3d(0.3, 0.3, 0.001)}, {0, 0, 0.02}, {0.005, 0, -0.01});
  expect(true, SphereShape{0.02}, {0.02, 0, 0}, {-0.02, 0.001, 0});
  expect(true, CylinderShape{0.02, 0.1}, {0.021, 0, 0}, {-0.021, 0, 0.03});
}

TEST(BetweenHands, FingersSideBySideStillTouch) {
  expect(false, BoxShape{Vector3d::Constant(0.04)}, {0.01, 0, 0.02}, {-0.01, 0, 0.02});
  expect(false, SphereShape{0.05}, {0.01, 0, 0.0489898}, {-0.01, 0, 0.0489898});
  expect(false, BoxShape{Vector3d::Constant(0.04)}, {0.01, 0, 0.03}, {-0.01, 0, 0.021});
}

// Depth of the chord beyond a tenth of its length, and beyond half of that.
TEST(BetweenHands, ContactDoesNotFlickerAtEdges) {
  const auto over = [](double half) { return std::sqrt(0.02 * 0.02 - half * half); };
  for (const double half : {0.0079, 0.005, 0.0035}) {
    const Vector3d at(half, 0, over(half)), other(-half, 0, over(half));
    const double depth = 0.02 - over(half);
    expect(depth > 0.2 * half, SphereShape{0.02}, at, other);
    expect(depth > 0.1 * half, SphereShape{0.02}, at, other, true);
  }
}

// As if the other hand were predicted too far.
TEST(BetweenHands, PositionInsideADeepSolidCounts) {
  const BoxShape cube{Vector3d::Constant(0.02)};
  expect(true, cube, {-0.03, 0, 0}, {0.005, 0, 0});
  expect(true, cube, {0.005, 0, 0}, {-0.03, 0, 0});
  expect(false, cube, {-0.005, 0, 0.01}, {0.005, 0, 0.009});
}

TEST(BetweenHands, FloorSeparatesNoHandsAboveIt) {
  const EffectPlan plan(scene_of(PlaneShape{Vector3d::UnitZ()}, 0.0));
  EXPECT_FALSE(is_between_hands(plan, {}, {0, 0, 0.001}, {0.03, 0, 0.001}, false));
}

}  // namespace
}  // namespace reckon::haptics
