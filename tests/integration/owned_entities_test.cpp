// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities of a peer besides one hand: posts that others press, tips that push them, two hands on
// two devices, many entities, none at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>

#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/field_of_peers.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;

// Peer 1 has a post and no device; peer 2 has a hand with `motion`.
std::string post_and_hand(std::string_view motion, std::string_view extra = "") {
  return R"(
[scene]
name = "post"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[hand]
radius = "10 mm"
k1 = "400 N/m"
[aoim]
pool = 16
[[entity]]
peer = 1
marking = "POST"
force_model = {kind = "region", radius = "30 mm", k1 = "600 N/m"}
)" + std::string(extra) +
         "[[operator]]\n" + std::string(motion) + R"(
stiffness = "300 N/m"
[[device]]
peer = 2
operator = 1
)";
}

// From above onto the post, which it reaches after half the period.
std::string pressing(std::string_view period) {
  return R"(sweep = {from = "0 0 30 mm", to = "0 0 0 mm", period = ")" + std::string(period) +
         "\"}";
}
constexpr std::string_view kHeld = "passive = true\nposition = \"0 0 100 mm\"";

const haptics::ServoSnapshot& servo(InProcess& world, std::size_t link) {
  return world.view(link).servo();
}

TEST(Post, OfAPeerWithoutDeviceIsFelt) {
  // The surface of the post is at z = 0, felt from 10 mm above because of the hand's radius. The
  // grip of 300 N/m pulls the hand to 0: f = 600 d = 300 (10 mm - d), so d = 10/3 mm and f = 2 N.
  const peer::SceneFile scene = scene_of(post_and_hand(pressing("16 s")));
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(8000);
  EXPECT_FALSE(world.peer(0).has_devices());
  EXPECT_EQ(world.view(0).hand_count, 0U);
  EXPECT_EQ(world.view(0).owned, 1U);
  ASSERT_EQ(world.view(1).entities, 1U);
  EXPECT_STREQ(world.view(1).rows[0].marking.data(), "POST");
  const haptics::ServoSnapshot& hand = servo(world, 1);
  EXPECT_NEAR(hand.force.z(), 2.0, 0.02);
  EXPECT_NEAR(hand.device.z(), 0.010 - 2.0 / 600.0, 5e-5);
  EXPECT_GE(hand.port_energy_min, -1e-9);
  // At rest it has no energy to give, and gives none.
  EXPECT_EQ(world.view(0).power_given, 0.0);
}

TEST(Post, IsSentOnceAndThenRarely) {
  const peer::SceneFile scene = scene_of(post_and_hand(kHeld));
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(5000);
  const auto before = world.count(0, "updates_out");
  world.run(60'000);
  EXPECT_GE(world.count(0, "updates_out") - before, 10U);  // the haptic heartbeat of 5 s
  EXPECT_LE(world.count(0, "updates_out") - before, 14U);
}

TEST(Post, IsFeltLongerThanItsModelsValidity) {
  const peer::SceneFile scene = scene_of(post_and_hand(pressing("80 s")));
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(40'000);
  EXPECT_NEAR(servo(world, 1).force.z(), 2.0, 0.02);
}

TEST(Post, OfTheOwnPeerIsFeltWithoutNetwork) {
  const std::string own = with(post_and_hand(pressing("60 s")), "peer = 2", "peer = 1");
  const peer::SceneFile scene = scene_of(own);
  InProcess world(1);
  world.start(0, scene);
  world.run(30'000);
  EXPECT_EQ(world.view(0).owned, 2U);
  EXPECT_NEAR(servo(world, 0).force.z(), 2.0, 0.02);
  EXPECT_GE(servo(world, 0).port_energy_min, -1e-9);
}

// A sphere under the hand rises from below and pushes it upwards, slowly.
std::string rising_tip(std::string_view power) {
  return "[[entity]]\npeer = 1\nmarking = \"TIP\"\nposition = \"0 0 -40 mm\"\npower = \"" +
         std::string(power) +
         "\"\nforce_model = {kind = \"sphere\", radius = \"15 mm\", k1 = \"600 N/m\"}\n";
}

class Tip : public testing::TestWithParam<bool> {
 protected:
  // The force on the hand after the tip has risen by 40 mm in 2 s, and its energy.
  struct Outcome {
    double force = 0, least_energy = 0, given = 0;
  };
  static Outcome raise(std::string_view power, bool own_peer) {
    constexpr std::string_view held = "passive = true\nposition = \"0 0 10 mm\"";
    const std::string text = with(post_and_hand(held, rising_tip(power)),
                                  "[[entity]]\npeer = 1\nmarking = \"POST\"\nforce_model = {kind = "
                                  "\"region\", radius = \"30 mm\", k1 = \"600 N/m\"}\n",
                                  "");
    const peer::SceneFile scene = scene_of(own_peer ? with(text, "peer = 2", "peer = 1") : text);
    InProcess world(own_peer ? 1 : 2);
    world.start(0, scene);
    if (!own_peer) world.start(1, scene);
    world.run(3000);
    const auto number = static_cast<peer::EntityNumber>(own_peer ? 2 : 1);
    for (int i = 1; i <= 2000; ++i) {
      peer::EntityTruth truth;
      truth.time = world.clock().now();
      truth.position = {0, 0, -0.040 + 0.040 * i / 2000.0};
      truth.velocity = {0, 0, 0.020};
      EXPECT_TRUE(world.peer(0).model().move(number, truth));
      world.run(1);
    }
    peer::EntityTruth rest;
    rest.time = world.clock().now();
    EXPECT_TRUE(world.peer(0).model().move(number, rest));
    world.run(3000);
    const std::size_t hand = own_peer ? 0 : 1;
    return {servo(world, hand).force.z(), servo(world, hand).port_energy_min,
            world.view(0).power_given};
  }
};
INSTANTIATE_TEST_SUITE_P(OfAnotherPeerAndOfOnesOwn, Tip, testing::Bool());

TEST_P(Tip, PushesAHandThroughBothSprings) {
  // Radii 15 and 10 mm, the tip's centre at 0, the hand's goal at 10 mm: f = 600 d = 300 (15 mm -
  // d) at the end: 3 N. The grip then stores (3 N)^2 / 600 N/m = 15 mJ, which the tip has given.
  const Outcome outcome = raise("50 mW", GetParam());
  EXPECT_NEAR(outcome.force, 3.0, 0.15);
  EXPECT_GE(outcome.least_energy, -1e-9);
  EXPECT_GT(outcome.given, 0.010);
  EXPECT_LE(outcome.given, 0.050 * 2.1 + 1e-9);
}

TEST_P(Tip, WithoutPowerGivesNothingAndPushesLess) {
  const Outcome outcome = raise("0 W", GetParam());
  EXPECT_LT(outcome.force, 2.7);
  EXPECT_GE(outcome.least_energy, -1e-9);
  EXPECT_EQ(outcome.given, 0.0);
}

// Two devices of one peer, whose hands have goals 12 mm apart and radii of 10 mm.
constexpr std::string_view kTwoHanded = R"(
[scene]
name = "two handed"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[hand]
radius = "10 mm"
k1 = "400 N/m"
damping = 0
[aoim]
pool = 16
[[operator]]
passive = true
position = "-6 0 0 mm"
stiffness = "200 N/m"
start = "0 s"
[[operator]]
sweep = {from = "60 0 0 mm", to = "6 0 0 mm", period = "16 s"}
stiffness = "200 N/m"
[[device]]
operator = 1
marking = "LEFT"
[[device]]
operator = 2
marking = "RIGHT"
position = "10 0 0 cm"
heading = "90 deg"
)";

TEST(TwoHanded, FeelEachOtherByTheSameBooks) {
  const peer::SceneFile scene = scene_of(kTwoHanded);
  InProcess world(1);
  world.start(0, scene);
  double least = 0, most = 0;
  for (int i = 0; i < 8000; ++i) {
    world.run(1);
    for (const peer::HandView& hand : world.view(0).own_hands()) {
      least = std::min(least, hand.servo.port_energy_min);
      most = std::max(most, hand.servo.force.norm());
    }
  }
  // Nearest to each other after 8 s: f = 400 d = 200 e each, d + 2 e = 8 mm.
  const double right = 400.0 * 0.008 / (1 + 2 * 400.0 / 200.0);
  const auto hands = world.view(0).own_hands();
  ASSERT_EQ(hands.size(), 2U);
  std::printf("two hands of one peer: %.3f and %.3f N, right is %.3f N\n",
              hands[0].servo.force.norm(), hands[1].servo.force.norm(), right);
  EXPECT_NEAR(hands[0].servo.force.x(), -right, 0.03 * right);
  EXPECT_NEAR(hands[1].servo.force.x(), right, 0.03 * right);
  EXPECT_GE(least, -1e-9);
  EXPECT_LE(most, 1.5 * right);
}

TEST(TwoHanded, AreTwoEntitiesToOthers) {
  const peer::SceneFile scene = scene_of(kTwoHanded);
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(1000);
  EXPECT_FALSE(world.peer(1).has_devices());
  ASSERT_EQ(world.view(1).count, 2U);
  EXPECT_STREQ(world.view(1).rows[0].marking.data(), "LEFT");
  EXPECT_STREQ(world.view(1).rows[1].marking.data(), "RIGHT");
  world.stop(0);
  world.run(100);
  EXPECT_EQ(world.view(1).entities, 0U);
}

TEST(OwnedEntities, AreFrozenOneByOne) {
  const peer::SceneFile scene = managed_by("anyone", scene_of(kTwoHanded));
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(1000);
  pdu::StopFreeze order;
  order.header.exercise_id = scene.network.exercise;
  order.originating_entity_id = {9, 9, 0};
  order.receiving_entity_id = {1, 1, 2};
  world.say(order, scene);
  world.run(200);
  ASSERT_EQ(world.view(1).count, 2U);
  EXPECT_FALSE(world.view(1).rows[0].frozen);
  EXPECT_TRUE(world.view(1).rows[1].frozen);
}

TEST(OwnedEntities, TenThousandAreShownWithinTwoSeconds) {
  peer::SceneFile scene = *peer::dis_exercise(1);
  scene.network.interop = false;
  scene.aoim.cell = 2000.0;
  scene.aoim.radius = 20'000.0;
  peer::ManualClock clock(seconds(1), std::chrono::hours(1));
  peer::SimulatedNetwork network({}, clock);
  peer::FederateOptions options;
  options.scene = scene;
  peer::Federate many(options, network.link(0), clock, 1);
  options.application = 2;
  peer::Federate one(options, network.link(1), clock, 2);
  one.subscribe(peer::EntityClass{});
  many.publish(peer::EntityClass{});
  peer::EntityDescription truck;
  truck.type.kind = pdu::EntityKind::platform;
  truck.type.domain = pdu::EntityDomain::land;
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      clock.advance(milliseconds(10));
      many.step();
      one.step();
    }
  };
  run(50);
  for (int i = 0; i < 10'000; ++i) {
    peer::EntityTruth truth;
    truth.position = {100.0 * (i % 100) - 5000.0, 100.0 * (i / 100) - 5000.0, 0.0};
    static_cast<void>(many.register_object(truck, truth));
  }
  run(200);
  EXPECT_EQ(one.size(), 10'000U);
  EXPECT_EQ(many.peer().counters().find("write_overflow")->value(), 0U);
  // Each is in place: the sum of all positions equals the sum over the grid.
  Vector3d sum = Vector3d::Zero();
  one.for_each([&](const peer::RemoteObject& object) { sum += object.shown(one.now()).position; });
  EXPECT_NEAR(sum.x(), -50.0 * 10'000, 1.0);
  EXPECT_NEAR(sum.y(), -50.0 * 10'000, 1.0);

  // Later they are silent: the heartbeat of land entities is 55 s.
  const auto before = many.peer().counters().find("updates_out")->value();
  run(1000);
  const auto updates = many.peer().counters().find("updates_out")->value() - before;
  EXPECT_LE(updates, 40'000U);  // repeated after 1, 2, 4 and 8 s
  EXPECT_EQ(one.size(), 10'000U);
}

// 200 posts with a heartbeat of 60 s. Singly they would need as many datagrams a minute; together
// they need some for each tenth of the heartbeat.
TEST(Posts, AtRestRepeatThemselvesTogether) {
  Field field(2, with(kField, "leaders = true\n", ""));
  field.start(0, 200);
  field.start(1, 1);
  field.world_.run(190'000);  // the repetitions after the start are over
  const auto count = [&](std::size_t link, const char* what) {
    return field.world_.count(link, what);
  };
  const std::uint64_t datagrams = count(0, "datagrams_out"), updates = count(0, "updates_out");
  const std::uint64_t others = count(1, "datagrams_out");
  field.world_.run(240'000);
  const double minutes = 4;
  const double sent = static_cast<double>(count(0, "updates_out") - updates) / minutes;
  // A peer with one post sends almost only presence.
  const double in = static_cast<double>(count(0, "datagrams_out") - datagrams -
                                        (count(1, "datagrams_out") - others)) /
                    minutes;
  std::cout << sent << " updates a minute in " << in << " datagrams beside presence\n";
  EXPECT_GE(sent, 195);
  EXPECT_LE(sent, 230);
  EXPECT_LE(in, 45);
  EXPECT_EQ(field.world_.view(1).entities, 200U);
}

}  // namespace
}  // namespace reckon::test
