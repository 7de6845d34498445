// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/static_contact.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kPeriod = 0.001;
constexpr double kDamping = 1.0;  // [N s/m], of the device

Scene box(const Surface& surface) {
  Scene scene;
  scene.objects.resize(1);
  scene.objects[0].name = "box";
  scene.objects[0].shape = BoxShape{Vector3d(0.04, 0.04, 0.04)};
  scene.objects[0].effects.of<SpringDamper>() = surface;
  return scene;
}

struct Outcome {
  double least = 0.0;  // [J], energy into port and device damping, summed from the start
  double extra = 0.0;  // [N], largest force of the effects
};

Vector3d hold(StaticContact& contact, PointTool& tool, EnergyPort& port, const Vector3d& velocity) {
  PortLoad load;
  tool.set_velocity(velocity);
  contact.load(tool, kPeriod, load);
  const PortHold held = port.hold(load, kPeriod);
  contact.shown(held.extra);
  return held.force;
}

// A hand that moves about a corner of a box with a damper, which gets velocities unrelated to the
// motion: an arbitrary force that feeds the hand on average.
Outcome wander(unsigned seed) {
  const EffectPlan plan(box({900.0, 200.0}));
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kPeriod);
  PointTool tool;
  std::mt19937 random(seed);
  std::normal_distribution<double> any;
  Vector3d device(0.021, 0.019, 0.019);
  tool.reset({device});
  contact.reset(tool);
  Outcome outcome;
  double energy = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    Vector3d force =
        hold(contact, tool, port, 0.3 * Vector3d(any(random), any(random), any(random)));
    const Vector3d spring = contact.walls().gain() * contact.result().force;
    outcome.extra = std::max(outcome.extra, (force - spring).norm());
    if (i % 97 == 0) {
      contact.attenuate(0.5, port);
      port.attenuate(0.5);
      force *= 0.5;
    }
    // Half the time the motion that takes most energy out of the force, otherwise any.
    Vector3d dx = 1e-4 * Vector3d(any(random), any(random), any(random));
    if (i % 2 == 0) dx = 0.5 * kPeriod / kDamping * force;
    dx += 0.01 * (Vector3d(0.02, 0.018, 0.018) - device);
    device += dx;
    energy += -force.dot(dx) + kDamping * dx.squaredNorm() / kPeriod;
    outcome.least = std::min(outcome.least, energy);
    port.settle(dx, kPeriod);
    tool.move({device});
    contact.settle(tool, kPeriod, port);
  }
  return outcome;
}

TEST(StaticContact, LimitsAFeedingForceToTheLedger) {
  Outcome all;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Outcome one = wander(seed);
    EXPECT_GE(one.least, -1e-12) << "seed " << seed;
    all.least = std::min(all.least, one.least);
    all.extra = std::max(all.extra, one.extra);
  }
  EXPECT_GT(all.extra, 1.0) << "nothing was tried";
  std::printf("least energy %.2g J, largest force %.2g N\n", all.least, all.extra);
}

TEST(StaticContact, RendersAFullDamperWithAFullLedger) {
  const EffectPlan plan(box({500.0, 2.0}));
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kPeriod);
  PointTool tool;
  Vector3d device(0.03, 0.0, 0.0);
  tool.reset({device});
  contact.reset(tool);
  const Vector3d dx(-5e-5, 0.0, 0.0);
  for (int i = 0; i < 220; ++i) {
    hold(contact, tool, port, dx / kPeriod);
    port.settle(dx, kPeriod);
    tool.move({device += dx});
    contact.settle(tool, kPeriod, port);
  }
  const Vector3d velocity(-0.05, 0.3, 0.0);
  const Vector3d force = hold(contact, tool, port, velocity);
  EXPECT_NEAR(force.x(), 500.0 * 0.001 + 2.0 * 0.05, 1e-5);
  EXPECT_EQ(force.y(), 0.0) << "along the normal alone";
}

TEST(StaticContact, FeelsAWallAtTheProbesRadius) {
  const EffectPlan plan(box({800.0, 0.0}));
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kPeriod, 0.005);
  PointTool tool;
  Vector3d device(0.03, 0.0, 0.0);
  tool.reset({device});
  contact.reset(tool);
  const Vector3d dx(-3e-5, 0.0, 0.0);
  for (int i = 0; i < 200; ++i) {
    hold(contact, tool, port, dx / kPeriod);
    port.settle(dx, kPeriod);
    tool.move({device += dx});
    contact.settle(tool, kPeriod, port);
  }
  EXPECT_NEAR(contact.result().scp.x(), 0.025, 1e-8);
  EXPECT_NEAR(hold(contact, tool, port, dx / kPeriod).x(), 0.8, 1e-4) << "1 mm of 5 is pressed in";
}

TEST(StaticContact, NeverPullsAgainstTheSpringsOfAllObjects) {
  // An acute wedge, and a hand pressed into its tip: the damper push of one side is a pull against
  // both springs.
  Scene scene;
  scene.objects.resize(2);
  scene.objects[0].shape = PlaneShape{Vector3d(1.0, 0.0, 0.0)};
  scene.objects[1].shape = PlaneShape{Vector3d(-0.8, 0.6, 0.0)};
  for (SceneObject& object : scene.objects) object.effects.of<SpringDamper>() = {500.0, 0.0};
  scene.objects[1].effects.of<SpringDamper>().damping = 10.0;
  const EffectPlan plan(scene);
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kPeriod);
  PointTool tool;
  const Vector3d start(0.03, 0.1, 0.0);
  const Vector3d end(-0.004, -0.002, 0.0);
  tool.reset({start});
  contact.reset(tool);
  for (int i = 1; i <= 1000; ++i) {
    const Vector3d dx = 0.001 * (end - start);
    hold(contact, tool, port, dx / kPeriod);
    port.settle(dx, kPeriod);
    tool.move({start + 0.001 * i * (end - start)});
    contact.settle(tool, kPeriod, port);
  }
  const Vector3d force = hold(contact, tool, port, Vector3d(0.8, -0.6, 0.0));
  const Vector3d springs = contact.walls().gain() * contact.result().force;
  EXPECT_GT((force - springs).norm(), 0.5) << "the damper is felt";
  EXPECT_NEAR(force.dot(springs), 0.0, 1e-12) << "as far as it does not pull";
}

}  // namespace
}  // namespace reckon::haptics
