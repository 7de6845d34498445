// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Least effective mass of a body at its surface, against closed forms.
#include "reckon/haptics/scene/least_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

PlannedObject body_of(const Shape& shape, double mass, double viscosity = 8.0) {
  Scene scene;
  SceneObject& object = scene.objects.emplace_back();
  object.name = "thing";
  object.shape = shape;
  object.matter.mass = mass;
  if (viscosity > 0) object.effects.of<SurfaceDrag>() = {viscosity};
  return EffectPlan(scene).objects().front();
}

TEST(LeastMass, MatchesClosedFormOfBallAndCube) {
  EXPECT_NEAR(body_of(SphereShape{0.02}, 0.7).least_mass, 0.2, 1e-12);
  // r^2 / I = (3/4) / (1/6) at a corner.
  EXPECT_NEAR(body_of(BoxShape{Vector3d::Constant(0.04)}, 1.1).least_mass, 0.2, 1e-12);
}

// For a rod 1 + 3 + 3: it turns about its middle and about itself. For a cylinder, at its rim 1 +
// (h/2)^2 / (r^2/4 + h^2/12) + r^2 / (r^2/2).
TEST(LeastMass, IsLeastAtEndsOfRodAndCylinder) {
  EXPECT_NEAR(body_of(BoxShape{Vector3d(1.0, 1e-4, 1e-4)}, 1.0).least_mass, 1.0 / 7, 1e-6);
  EXPECT_NEAR(body_of(CylinderShape{0.02, 0.1}, 1.0).least_mass, 1.0 / 5.68, 0.005);
}

TEST(LeastMass, BoundsOnlySpeedDependentEffects) {
  const PlannedObject light = body_of(SphereShape{0.02}, 0.007);
  EXPECT_NEAR(light.most_viscosity(1e-3), 0.6, 1e-12);
  EXPECT_NEAR(light.most_viscosity(2.5e-4), 2.4, 1e-12);
  EXPECT_TRUE(std::isinf(body_of(SphereShape{0.02}, 0.007, 0.0).least_mass));
  EXPECT_TRUE(std::isinf(body_of(SphereShape{0.02}, 0.0).least_mass));
}

// A damper reverses a light body along the normal, as drag does along the surface.
TEST(LeastMass, BoundsTheDamperOfASurface) {
  Scene scene;
  SceneObject& ball = scene.objects.emplace_back();
  ball.name = "ball";
  ball.shape = SphereShape{0.02};
  ball.matter.mass = 0.007;
  ball.effects.of<SpringDamper>() = {500.0, 2.0};
  EffectContact contact;
  contact.in_contact = true;
  contact.normal = Vector3d::UnitZ();
  contact.spring = 3.0 * Vector3d::UnitZ();
  contact.velocity = Vector3d(0.3, 0, -0.1);
  const SpringDamper surface({500.0, 2.0});
  EXPECT_NEAR(surface.force(contact).z(), 0.2, 1e-12);
  contact.most_viscosity = EffectPlan(scene).objects().front().most_viscosity(1e-3);
  EXPECT_NEAR(surface.force(contact).z(), 0.06, 1e-12);
  contact.velocity = -contact.velocity;
  EXPECT_NEAR(surface.force(contact).z(), -0.06, 1e-12);
}

}  // namespace
}  // namespace reckon::haptics
