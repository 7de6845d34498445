// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer that starts and stops a thousand times leaves nothing behind, in itself or in other peers.
#include <gtest/gtest.h>
#include <malloc.h>

#include <filesystem>
#include <thread>

#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/peer_threads.hpp"
#include "reckon/tests/support/in_process.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::test {
namespace {

std::size_t entries(const char* folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

TEST(StartStop, AThousandCyclesAreClean) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(2);
  world.start(0, scene);
  const auto cycle = [&](std::uint32_t life) {
    world.start(1, scene, 1000 + life, 2);
    const auto met = [&] { return world.view(0).entities == 1 && world.view(1).entities == 1; };
    ASSERT_LE(world.run_until(met, 1000), 999u) << "life " << life;
    world.stop(1);
    const auto left = [&] { return world.view(0).entities == 0; };
    ASSERT_LE(world.run_until(left, 100), 99u) << "life " << life;
  };
  std::size_t used = 0;
  for (std::uint32_t life = 0; life < 1000; ++life) {
    cycle(life);
    if (HasFatalFailure()) return;
    if (life == 100) used = mallinfo2().uordblks;
  }
  // Nothing grows: after 900 more starts the heap in use is the same.
  EXPECT_LE(mallinfo2().uordblks, used + 65'536);
  EXPECT_EQ(world.count(0, "left"), 1000u);
  EXPECT_EQ(world.count(0, "timed_out"), 0u);
  EXPECT_EQ(world.count(0, "datagrams_lost"), 0u);
  EXPECT_GE(world.view(0).servo().step + 52, world.steps());  // minus one snapshot
}

TEST(StartStop, ADeadPeerLeavesNothingEither) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(2);
  world.start(0, scene);
  for (std::uint32_t life = 0; life < 50; ++life) {
    world.start(1, scene, 1000 + life, 2);
    const auto met = [&] { return world.view(1).entities == 1; };
    ASSERT_LE(world.run_until(met, 1000), 999u) << "life " << life;
    world.run(60);
    world.kill(1);
    world.run(100);
  }
  const auto gone = [&] { return world.view(0).entities == 0; };
  EXPECT_LE(world.run_until(gone, 10'000), (kPresenceTimeout + kPicture) / milliseconds(1));
}

// One peer with sockets and threads on loopback, in groups of no other program.
void run_on_loopback(const peer::SceneFile& scene, std::uint32_t epoch) {
  const peer::SteadyClock clock;
  peer::UdpMulticastOptions udp;
  udp.interface = "lo";
  peer::UdpMulticast link(udp, clock);
  const auto hand = tools::make_simulated_hand(scene, 0);
  peer::PeerOptions own;
  own.epoch = epoch;
  peer::Peer peer(scene, own, link, *hand);
  peer.start(clock.now());
  {
    peer::PeerThreads threads(peer, clock, {});
    std::this_thread::sleep_for(milliseconds(50));
    threads.stop();
    EXPECT_GT(threads.servo_duty().steps(), 5u);
  }
  peer.stop(clock.now(), clock.utc_now());
  EXPECT_GE(peer.counters().find("datagrams_out")->value(), 2u);  // announcement and farewell
  EXPECT_EQ(peer.counters().find("send_errors")->value(), 0u);
  EXPECT_EQ(peer.counters().find("join_errors")->value(), 0u);
}

TEST(StartStop, TwentyCyclesWithSocketsAndThreadsAreClean) {
  if (!std::filesystem::exists("/proc/self/fd")) GTEST_SKIP() << "needs /proc to count descriptors";
  const peer::SceneFile scene = scene_of(with(
      kTwoHandsOnAWall, "[hand]", "[network]\ngroup = \"239.192.77.0\"\nport = 34567\n\n[hand]"));
  run_on_loopback(scene, 1);
  const std::size_t descriptors = entries("/proc/self/fd");
  const std::size_t threads = entries("/proc/self/task");
  for (std::uint32_t life = 2; life <= 21; ++life) run_on_loopback(scene, life);
  EXPECT_EQ(entries("/proc/self/fd"), descriptors);
  EXPECT_EQ(entries("/proc/self/task"), threads);
}

TEST(StartStop, TwoLivePeersMeetWithinASecond) {
  const peer::SceneFile scene = scene_of(with(
      kTwoHandsOnAWall, "[hand]", "[network]\ngroup = \"239.192.78.0\"\nport = 34567\n\n[hand]"));
  tools::Exercise exercise(scene, {});
  exercise.run(seconds(2));
  EXPECT_GE(exercise.remote_seen(), nanoseconds(0));
  EXPECT_LT(exercise.remote_seen(), seconds(1));
  exercise.stop();
  EXPECT_EQ(exercise.total("datagrams_lost"), 0u);
  EXPECT_GE(exercise.measurement().energy_min(), -1e-9);
}

}  // namespace
}  // namespace reckon::test
