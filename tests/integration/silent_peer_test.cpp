// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers that fall silent without a leave announcement: how long they are felt, and how far they are
// extrapolated. A peer on a bad network must not be doubted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "reckon/peer/loops/silence_watch.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::string kScene = R"(
[scene]
name = "silence"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[aoim]
pool = 16
)";

// One hand comes and presses against another; both rest from then on.
const std::string kGrip = kScene + R"(
[[operator]]
sweep = {from = [-0.03, 0.0, 0.0], to = [0.0, 0.0, 0.0], period = "120 s"}

[[operator]]
passive = true
position = [0.010, 0.0, 0.0]
stiffness = "150 N/m"
)";

// Two hands that move back and forth, far from each other.
const std::string kSweep = kScene + R"(
[[operator]]
sweep = {from = [-0.1, 0.0, 0.0], to = [0.1, 0.0, 0.0], period = "2 s"}

[[operator]]
passive = true
position = [0.0, 1.0, 0.0]
stiffness = "150 N/m"
)";
constexpr double kSweepSpeed = 0.32;  // [m/s], the maximum: pi times 0.2 m in 2 s

constexpr double kNoEnergyMade = -1e-9;  // [J]

// Force of the other hand on a peer's hand, in its newest snapshot [N].
double felt(InProcess& world, std::size_t link) {
  const haptics::ServoSnapshot& servo = world.view(link).servo();
  double most = 0;
  for (std::size_t i = 0; i < servo.count; ++i)
    most = std::max(most, servo.contacts[i].force.norm());
  return most;
}

struct Grip {
  explicit Grip(std::string_view text = kTwoHandsOnAWall, const peer::ImpairmentLaw& law = {},
                std::uint64_t seed = 1)
      : scene(scene_of(text)), world(2, seed) {
    world.network().impair(law);
    world.listen(scene);
    world.start(0, scene);
    world.start(1, scene);
  }
  [[nodiscard]] bool press(double newtons) {
    const auto both = [&] { return felt(world, 1) > newtons && felt(world, 0) > newtons; };
    return world.run_until(both, 60'000) <= 60'000;
  }

  const peer::SceneFile scene;
  InProcess world;
};

TEST(KilledPeer, IsFeltFor750MsAfterItsDeath) {
  for (const int later : {0, 7, 31, 58}) {
    Grip grip;
    InProcess& world = grip.world;
    ASSERT_TRUE(grip.press(0.2));
    world.run(static_cast<std::size_t>(later));
    world.kill(0);
    ASSERT_FALSE(world.heard().empty());
    const nanoseconds killed = world.clock().now();
    const auto gone = [&] { return felt(world, 1) == 0.0; };
    EXPECT_GT(felt(world, 1), 0.0);
    ASSERT_LE(world.run_until(gone, 2000), 2000u);
    const nanoseconds felt_for = world.clock().now() - killed;
    RecordProperty("felt_for_ms", std::to_string(felt_for.count() / 1'000'000));
    EXPECT_LE(felt_for, milliseconds(750) + kPicture);
    EXPECT_GE(felt_for, milliseconds(650 - 60)) << "it was not doubted but forgotten";
    EXPECT_THAT(world.notices(1), Contains(HasSubstr("its hands are no longer felt")));
    EXPECT_EQ(world.view(1).entities, 1u) << "it is still there, at rest";
    const auto dropped = [&] { return world.view(1).entities == 0; };
    ASSERT_LE(world.run_until(dropped, 7000), 7000u);
    const nanoseconds there = world.clock().now() - killed;
    EXPECT_LE(there, kPresenceTimeout + kPicture);
    EXPECT_GE(there, kPresenceTimeout - milliseconds(100));
    EXPECT_GE(world.view(1).servo().port_energy_min, kNoEnergyMade);
  }
}

TEST(KilledPeer, StopsWithin3SecondsOfItsSpeedWhenSweeping) {
  // Quarters and eighths of its path: fast, slow, and turning back.
  for (const std::size_t when : {4000u, 4250u, 4500u, 4750u, 5000u, 5250u, 5500u, 5750u}) {
    SCOPED_TRACE(when);
    Grip grip(kSweep);
    InProcess& world = grip.world;
    world.run(when);
    const nanoseconds killed = world.clock().now();
    world.kill(0);
    const auto rows = [&] { return world.peer(1).model().remote().rows(); };
    ASSERT_EQ(rows().size(), 1u);
    const auto shown = [&] { return rows()[0].shown(world.clock().now()); };
    const Eigen::Vector3d start = shown().position;
    Eigen::Vector3d before = start, step = shown().velocity * 1e-3;
    while (world.clock().now() - killed < milliseconds(6000)) {
      world.run(1);
      const Eigen::Vector3d now = shown().position;
      EXPECT_LE((now - start).norm(), 3.0 * kSweepSpeed);
      // No jump: the displacement of a millisecond changes by 20 m/s^2 at most.
      EXPECT_LE((now - before - step).norm(), 2e-5 + 1e-9);
      step = now - before;
      before = now;
    }
    EXPECT_LE(step.norm(), 1e-12);
    EXPECT_EQ(shown().velocity.norm(), 0.0);
  }
}

TEST(KilledPeer, CostsTheOthersNoUpdate) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(3);
  for (std::size_t i = 0; i < 3; ++i) world.start(i, scene);
  world.run(3000);
  world.kill(0);
  world.run(9000);
  for (const std::size_t link : {1u, 2u}) {
    EXPECT_EQ(world.view(link).entities, 1u);
    EXPECT_EQ(world.count(link, "datagrams_lost"), 0u);
    EXPECT_EQ(world.count(link, "peers_doubted"), 1u);
    EXPECT_EQ(world.count(link, "timed_out"), 1u);
  }
}

// A peer that is received again is felt as before, and continues without a jump.
TEST(SilentPeer, ReturnsWithItsForceWithoutMakingEnergy) {
  for (const int outage : {800, 1500, 3000, 5000}) {
    SCOPED_TRACE(outage);
    peer::ImpairmentLaw law;
    law.outages = {{seconds(60), milliseconds(outage)}};
    Grip grip(kGrip, law);
    InProcess& world = grip.world;
    world.run(60'000);
    ASSERT_GT(felt(world, 1), 0.3);
    world.run(static_cast<std::size_t>(outage));
    EXPECT_EQ(felt(world, 1), 0.0);
    world.run(3000);
    Grip twin(kGrip);  // without an outage
    twin.world.run(static_cast<std::size_t>(63'000 + outage));
    EXPECT_GT(felt(world, 1), 0.9 * felt(twin.world, 1));
    EXPECT_GT(felt(world, 0), 0.9 * felt(twin.world, 0));
    for (const std::size_t link : {0u, 1u}) {
      EXPECT_GE(world.view(link).servo().port_energy_min, kNoEnergyMade);
      EXPECT_EQ(world.count(link, "timed_out"), 0u);
      EXPECT_THAT(world.notices(link), Contains(HasSubstr("is received again")));
    }
  }
}

// A peer loses ten datagrams in a row once in four hours. A soak of 32 minutes may see that once; a
// gate of eight does not.
TEST(SilentPeer, IsNotDoubtedInContactOnBadNetworks) {
  peer::ImpairmentLaw law;
  law.loss = 0.3;
  law.delay = milliseconds(200);
  law.jitter = milliseconds(50);
  std::size_t doubted = 0;
  for (std::uint64_t seed = 1; seed <= tries(4U, 16U); ++seed) {
    SCOPED_TRACE(seed);
    Grip grip(kGrip, law, seed);
    grip.world.run(50'000);
    ASSERT_GT(felt(grip.world, 1), 0.1);
    static_cast<void>(grip.world.notices(0));
    static_cast<void>(grip.world.notices(1));
    grip.world.run(60'000);
    for (const std::size_t link : {0u, 1u}) {
      for (const std::string& notice : grip.world.notices(link))
        doubted += notice.find("no longer felt") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_LE(doubted, tries(0U, 1U));
}

TEST(SilentPeer, IsNotDoubtedForOutagesBelow500Ms) {
  peer::ImpairmentLaw law;
  law.delay = milliseconds(30);
  law.jitter = milliseconds(20);
  law.outages = {{seconds(40), milliseconds(490), seconds(3)}};
  Grip grip(kGrip, law);
  grip.world.run(80'000);
  for (const std::size_t link : {0u, 1u}) {
    EXPECT_GT(felt(grip.world, link), 0.1);
    EXPECT_THAT(grip.world.notices(link), Not(Contains(HasSubstr("no longer felt"))));
  }
}

// A stopped peer cannot know whether the others were silent.
TEST(SilentPeer, IsNotTheOneThatListensToNobody) {
  Grip grip(kGrip);
  InProcess& world = grip.world;
  world.run(60'000);
  static_cast<void>(world.notices(1));
  world.clock().advance(seconds(2));  // both were stopped
  world.run(500);
  EXPECT_THAT(world.notices(1), Not(Contains(HasSubstr("no longer felt"))));
  EXPECT_EQ(world.count(0, "peers_doubted") + world.count(1, "peers_doubted"), 0u);
}

// Alive, and silent except for its announcements: resting hands apart send no more.
TEST(SilentPeer, IsNotAHandAtRest) {
  Grip grip(with(kGrip, "position = [0.010", "position = [0.1"));
  InProcess& world = grip.world;
  world.run(60'000);
  EXPECT_EQ(world.count(0, "peers_doubted") + world.count(1, "peers_doubted"), 0u);
}

}  // namespace
}  // namespace reckon::test
