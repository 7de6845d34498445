// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and accuracy of dead reckoning on a good network: small errors for few packets.
#include <gtest/gtest.h>

#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::test {
namespace {

constexpr double kRawPacketsPerSecond = 1000.0;   // one update a servo step
constexpr double kRawOctets = 144 + 32 + 8 + 72;  // Entity State and Attribute with one force model

struct Bounds {
  double pose = 1e-3;   // [m]
  double force = 0.1;   // [N]
  double share = 0.02;  // of raw streaming
};

void expect_within(const peer::SceneFile& scene, nanoseconds span, const Bounds& bounds) {
  tools::ExerciseOptions options;
  options.simulated_time = true;
  options.epoch = 1;
  tools::Exercise exercise(scene, options);
  exercise.run(span);
  const double peer_seconds = 2.0 * std::chrono::duration<double>(span).count();
  const peer::Spread pose = exercise.measurement().pose_error();
  const peer::Spread force = exercise.measurement().force_error();
  const double packets = static_cast<double>(exercise.total("datagrams_out")) / peer_seconds;
  const double octets = static_cast<double>(exercise.total("octets_out")) / peer_seconds;
  std::printf(
      "pose p50 %.3f p99 %.3f mm, force p50 %.4f p99 %.4f N over %.1f s of contact, "
      "%.1f packets/s (%.0f x fewer), %.0f octets/s (%.0f x fewer) a peer\n",
      1e3 * pose.p50, 1e3 * pose.p99, force.p50, force.p99, exercise.measurement().touching_hands(),
      packets, kRawPacketsPerSecond / packets, octets, kRawPacketsPerSecond * kRawOctets / octets);
  EXPECT_GT(exercise.measurement().touching_hands(), 1.0);
  EXPECT_GT(pose.count, 1000u);
  EXPECT_LE(pose.p99, bounds.pose);
  EXPECT_LE(force.p99, bounds.force);
  EXPECT_LE(packets, bounds.share * kRawPacketsPerSecond);
  EXPECT_LE(octets, bounds.share * kRawPacketsPerSecond * kRawOctets);
  EXPECT_EQ(exercise.total("datagrams_lost"), 0u);
  EXPECT_GE(exercise.measurement().energy_min(), -1e-9);
}

// The recorded hands touch each other from the third second on.
TEST(OwnHand, MeetsItsThresholdsOnTheShippedScene) {
  expect_within(shipped_scene(), seconds(60), {});
}

// A hand that pushes another across a wall with friction, on and off each second, is the hard case:
// no predictor can foresee the accelerations of stick and slip.
TEST(OwnHand, StaysBoundedWhilePushingAnotherAcrossAWall) {
  expect_within(scene_of(kTwoHandsOnAWall), seconds(30), {2e-3, 0.4, 1.0 / 15.0});
}

// It is repeated before its force fades, however long the heartbeat.
TEST(OwnHand, IsNotForgottenBetweenSlowHeartbeats) {
  for (const char* validity : {"12 s", "30 s"}) {
    const peer::SceneFile scene = scene_of(with(
        with(kTwoHandsOnAWall, "position = [0.015, 0.0, 0.001]", "position = [0.5, 0.0, 0.001]"),
        "[hand]",
        std::string("[dead_reckoning]\nheartbeat = \"60 s\"\n[hand]\nvalidity = \"") + validity +
            "\""));
    InProcess world(2);
    world.start(0, scene);
    world.start(1, scene);
    world.run(1000);
    for (int second = 0; second < tries(80, 150); ++second) {
      world.run(1000);
      const auto rows = world.peer(0).model().remote().rows();
      ASSERT_EQ(rows.size(), 1u) << validity << ' ' << second;
      ASSERT_GE(rows[0].valid_until, world.clock().now()) << validity << ' ' << second;
    }
    EXPECT_EQ(world.count(0, "timed_out"), 0u);
  }
}

// A resting hand in free air sends only heartbeats.
TEST(OwnHand, SendsLittleAtRest) {
  const peer::SceneFile scene = scene_of(R"(
[scene]
name = "still"
[[operator]]
passive = true
position = [0.0, 0.0, 0.1]
[[operator]]
passive = true
position = [0.3, 0.0, 0.1]
)");
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(2000);
  const auto before = world.count(1, "updates_in");
  world.run(60'000);
  const auto updates = world.count(1, "updates_in") - before;
  EXPECT_GE(updates, 11u);  // heartbeat 5 s
  EXPECT_LE(updates, 14u);
  EXPECT_EQ(world.view(1).entities, 1u);
}

}  // namespace
}  // namespace reckon::test
