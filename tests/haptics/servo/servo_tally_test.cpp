// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo reports forces rendered below the requested ones, and late steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::servo_tally_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr double kReach = 0.03;  // [m], of a remote hand and the probe

ContactSet balls(const std::vector<Vector3d>& centres, double k1) {
  ContactSet set;
  for (const Vector3d& centre : centres) {
    RemoteHand& hand = set.hands[set.count++];
    hand.id = {1, 2, static_cast<std::uint16_t>(set.count)};
    hand.state.position = centre;
    hand.model.kind = pdu::ForceModelKind::sphere;
    hand.model.k1 = k1;
    hand.model.radius = kReach - 0.01;
    hand.valid_until = 1000s;
    hand.version = 1;
  }
  return set;
}

/// A servo with a device held by a hand, and every snapshot of it.
class Bench {
 public:
  explicit Bench(SimulatedDeviceConfig config = {}, HandScript script = {}, Scene scene = {})
      : device(config, std::move(script)), servo(device, EffectPlan(scene), {}) {}

  const ServoSnapshot& step(nanoseconds after = 1ms) {
    servo.step(now += after);
    servo.snapshots().update();
    return servo.snapshots().read();
  }

  SimulatedDevice device;
  ServoLoop servo;
  nanoseconds now{0};
};

// A surface moves quickly into a resting hand: its operator puts in only the damping loss of an
// earlier short motion.
TEST(ServoTally, GivesDurationAndAmountOfHeldBackContacts) {
  SimulatedDeviceConfig config;
  config.damping = 0.75;
  Bench bench(config, [](double t) {
    HandTarget hand;
    hand.position.x() = 0.01 * std::min(1.0, 10.0 * t);
    return hand;
  });
  ContactSet set = balls({Vector3d(0.01, 0, -0.05)}, 600);
  set.hands[0].state.velocity.z() = 0.14;  // slower than a blow
  set.hands[0].state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  bench.servo.contacts().write(set);
  double worst = 0, seconds = 0, touching = 0;
  Shortfall expected;
  ServoSnapshot last;
  for (int i = 0; i < 250; ++i) {
    last = bench.step();
    ASSERT_EQ(last.count, 1u);
    const ContactAccount& contact = last.contacts[0];
    const double lacks = (contact.asked_force - contact.force).norm();
    ASSERT_NEAR(lacks, (1 - last.spring_share) * contact.asked_force.norm(), 1e-12) << i;
    if (contact.asked_force.norm() > 0) touching += 0.001;
    if (lacks > 0.001 && lacks > 0.01 * contact.asked_force.norm()) seconds += 0.001;
    if (lacks <= worst) continue;
    worst = lacks;
    expected.asked = contact.asked_force.norm();
    expected.share = contact.force.norm() / expected.asked;
  }
  EXPECT_GT(worst, 0.2) << "[N]; else nothing is tested";
  EXPECT_GT(expected.share, 0.05) << "nor where all of it is held back";
  EXPECT_NEAR(last.tally.held_back.seconds, seconds, 1e-9);
  EXPECT_NEAR(last.tally.hands, touching, 1e-9);
  EXPECT_NEAR(last.tally.held_back.share, expected.share, 1e-9);
  EXPECT_NEAR(last.tally.held_back.asked, expected.asked, 1e-9);
}

TEST(ServoTally, IsEmptyIfAllForcesAreRendered) {
  SimulatedDeviceConfig config;
  config.start.z() = 0.035;
  Bench bench(config, [](double t) {
    HandTarget hand;
    hand.position.z() = 0.035 - 0.01 * std::min(1.0, t);
    return hand;
  });
  bench.servo.contacts().write(balls({Vector3d::Zero()}, 500));
  for (int i = 0; i < 2000; ++i) (void)bench.step();
  const ServoTally& tally = bench.step().tally;
  EXPECT_GT(tally.hands, 0.5);
  EXPECT_EQ(tally.held_back.seconds, 0.0);
  EXPECT_EQ(tally.crowd.seconds, 0.0);
  EXPECT_EQ(tally.limit.seconds, 0.0);
  EXPECT_EQ(tally.late, 0u);
  EXPECT_EQ(tally.scene, 0.0);
}

// Four springs of 900 N/m in one direction on a device of 1900 N/m.
TEST(ServoTally, ReportsSoftenedCrowdsOfHands) {
  SimulatedDeviceConfig config;
  config.hand_stiffness = 1000;
  config.start.z() = 0.035;
  Bench bench(config, [](double t) {
    HandTarget hand;
    hand.position.z() = 0.035 - 0.015 * std::min(1.0, t);
    return hand;
  });
  bench.servo.contacts().write(balls(std::vector<Vector3d>(4, Vector3d::Zero()), 900));
  for (int i = 0; i < 2000; ++i) (void)bench.step();
  const ServoSnapshot& s = bench.step();
  const double share = bench.servo.body_stiffness_limit() / 3600;
  EXPECT_NEAR(s.crowd_share, share, 1e-6);
  EXPECT_NEAR(s.tally.crowd.share, share, 1e-6);
  EXPECT_GT(s.tally.crowd.seconds, 1.0);
  EXPECT_NEAR(s.contacts[0].force.norm(), s.crowd_share * s.contacts[0].asked_force.norm(), 1e-9);
}

// A floor of 1000 N/m under a grip of 300 N/m with a goal 35 mm inside: the device gives 2 N, and
// the requested force is the floor's at the depth where 2 N balance the grip.
TEST(ServoTally, GivesDurationAndAmountOfForceLimiting) {
  SimulatedDeviceConfig config;
  config.max_force = 2.0;
  config.start.z() = 0.005;
  Scene scene;
  scene.objects.resize(1);
  scene.objects[0].name = "floor";
  scene.objects[0].shape = PlaneShape{};
  scene.objects[0].effects.of<SpringDamper>() = {1000, 0.0};
  Bench bench(
      config,
      [](double t) {
        HandTarget hand;
        hand.position.z() = 0.005 - 0.04 * std::min(1.0, t);
        return hand;
      },
      scene);
  double seconds = 0.0;
  ServoSnapshot last;
  for (int i = 0; i < 2000; ++i) {
    last = bench.step();
    EXPECT_LE(last.force.norm(), 2.0 + 1e-9);
    if (last.limit_share < 0.99) seconds += 1e-3;
  }
  EXPECT_GT(seconds, 0.5) << "else nothing is tested";
  EXPECT_NEAR(last.tally.limit.seconds, seconds, 2e-3);
  EXPECT_LT(last.tally.limit.share, 1.0);
  EXPECT_NEAR(last.tally.limit.share * last.tally.limit.asked, 2.0, 1e-9);
  const double depth = 0.035 - 2.0 / config.hand_stiffness;
  EXPECT_NEAR(last.tally.limit.asked, 1000 * depth, 10.0);
  EXPECT_NEAR(last.limit_share, 2.0 / (1000 * depth), 1e-3);
}

TEST(ServoTally, CountsLateStepsAndReleasedForces) {
  SimulatedDeviceConfig config;
  config.hold = 1500us;
  config.start.z() = -0.005;
  Scene scene;
  SceneObject floor;
  floor.name = "floor";
  floor.shape = PlaneShape{};
  floor.effects.of<SpringDamper>() = {600, 0.0};
  scene.objects = {floor};
  Bench bench(
      config,
      [](double t) {
        HandTarget hand;
        hand.position.z() = t < 0.1 ? 0.005 : -0.01;
        return hand;
      },
      scene);
  for (int i = 0; i < 60; ++i) (void)bench.step();
  EXPECT_EQ(bench.step(3ms).tally.late, 1u);
  EXPECT_EQ(bench.step(1400us).tally.late, 1u) << "within half a period";
  EXPECT_EQ(bench.step().tally.force_drops, 0u) << "there was no force yet";
  for (int i = 0; i < 500; ++i) (void)bench.step();
  EXPECT_GT(bench.step().force.norm(), 0.5);
  const ServoSnapshot& s = bench.step(5ms);
  EXPECT_EQ(s.tally.late, 2u);
  EXPECT_EQ(s.tally.force_drops, 1u);
  EXPECT_EQ(s.tally.failed, 0u);
  bench.device.plug(false);
  (void)bench.step();
  EXPECT_EQ(bench.step().tally.failed, 2u);
  EXPECT_GT(bench.step().tally.scene, 0.4);
}

TEST(ServoTally, ReportsAnInvalidRecord) {
  Bench bench;
  ContactSet set = balls({Vector3d(0, 0, -0.02)}, 400);
  bench.servo.contacts().write(set);
  EXPECT_FALSE(bench.step().contacts[0].refused);
  set.hands[0].version = 2;
  set.hands[0].model.damping = std::numeric_limits<double>::quiet_NaN();
  bench.servo.contacts().write(set);
  EXPECT_TRUE(bench.step().contacts[0].refused);
  EXPECT_NEAR(bench.step().tally.refused, 0.002, 1e-12);
  set.hands[0].version = 3;
  set.hands[0].model.damping = 0;
  bench.servo.contacts().write(set);
  EXPECT_FALSE(bench.step().contacts[0].refused);
}

TEST(Shortfall, KeepsTheStepWithTheGreatestShortfall) {
  Shortfall s;
  s.note(1.0, 5.0, 0.001);
  s.note(0.995, 5.0, 0.001);   // 1 % is not noticeable
  s.note(0.0, 0.0005, 0.001);  // nor is this
  EXPECT_EQ(s.seconds, 0.0);
  s.note(0.1, 0.1, 0.001);
  s.note(0.5, 2.0, 0.002);
  s.note(0.2, 1.0, 0.001);
  EXPECT_DOUBLE_EQ(s.seconds, 0.004);
  EXPECT_EQ(s.share, 0.5);
  EXPECT_EQ(s.asked, 2.0);
}

}  // namespace
}  // namespace reckon::haptics::servo_tally_test
