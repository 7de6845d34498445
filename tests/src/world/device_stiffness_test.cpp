// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/device_stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/peer/drivers/device_config.hpp"
#include "reckon/peer/settings/hand_config.hpp"

namespace reckon::peer {
namespace {

DeviceStiffness of(double damping, double wall, const HandModel& hand, double spring = 0) {
  haptics::SimulatedDeviceConfig config;
  config.damping = damping;
  haptics::SimulatedDevice device(config);
  haptics::Scene scene;
  haptics::SceneObject floor;
  floor.name = "floor";
  floor.shape = haptics::PlaneShape{};
  floor.effects.of<haptics::SpringDamper>() = {wall, 0.0};
  scene.objects = {floor};
  if (spring > 0) scene.regions.emplace_back().effects.declare<haptics::PointSpring>() = {spring};
  const haptics::ServoLoop servo(device, haptics::EffectPlan(scene), {});
  return stiffness_of(servo, hand);
}

// 0.95 of 2 b/T; walls get 3/4 of it and hands half.
TEST(DeviceStiffness, FollowsTheDamping) {
  HandModel hand;
  hand.k1 = 1500;
  hand.damping = 0;
  const DeviceStiffness weak = of(1.0, 20000, hand);
  EXPECT_NEAR(weak.walls_shown(), 1425, 1e-9);
  EXPECT_EQ(weak.walls_asked, 20000);
  EXPECT_TRUE(weak.softens_walls());
  EXPECT_NEAR(weak.hand_shown(), 950, 1e-9);
  EXPECT_TRUE(weak.softens_hand());
  const DeviceStiffness strong = of(20.0, 20000, hand);
  EXPECT_FALSE(strong.softens_walls());
  EXPECT_EQ(strong.walls_shown(), 20000);
  EXPECT_EQ(strong.hand_shown(), 1500);
}

// Regions get a quarter of the walls' share, if there is a region.
TEST(DeviceStiffness, LeavesAPartToRegions) {
  const DeviceStiffness weak = of(1.0, 20000, {}, 800), strong = of(20.0, 0, {}, 800);
  EXPECT_NEAR(weak.walls_shown(), 0.75 * 1425, 1e-9);
  EXPECT_NEAR(weak.regions_shown(), 0.25 * 1425, 1e-9);
  EXPECT_EQ(weak.regions_asked, 800);
  EXPECT_TRUE(weak.softens_regions());
  EXPECT_FALSE(strong.softens_regions());
}

TEST(DeviceStiffness, GivesTheDepthWhereAHandStopsHardening) {
  HandModel hand;
  hand.k1 = 500;
  hand.damping = 0;
  EXPECT_TRUE(std::isinf(of(1.0, 0, hand).straight_from()));
  hand.k3 = 1.5e7;
  const double depth = of(1.0, 0, hand).straight_from();
  EXPECT_NEAR(hand.k1 + 3 * hand.k3 * depth * depth, 950, 1e-9) << "the slope there";
  EXPECT_GT(of(2.0, 0, hand).straight_from(), depth);
}

TEST(DeviceStiffness, LeavesLessForASpringBesideADamper) {
  HandModel hand;
  hand.k1 = 600;
  hand.damping = 0.25;
  EXPECT_NEAR(of(1.0, 0, hand).hand_limit(), 0.75 * 950, 1e-9);
  EXPECT_FALSE(of(1.0, 0, hand).softens_hand());
  hand.damping = 2;  // half of the device's own damping is shown
  EXPECT_NEAR(of(1.0, 0, hand).hand_shown(), 475, 1e-9);
  EXPECT_TRUE(of(1.0, 0, hand).softens_hand());
  EXPECT_EQ(of(1.0, 0, hand).damper_shown(2), 0.5);
}

}  // namespace
}  // namespace reckon::peer
