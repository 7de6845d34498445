// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers whose process is stopped for seconds, as by SIGSTOP or on a suspended laptop.
#include <gtest/gtest.h>

#include <cmath>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

// Seconds by which an hour timestamp is older than `utc`.
double age_of(std::uint32_t timestamp, nanoseconds utc) {
  const std::uint32_t now = pdu::to_dis_timestamp(utc, true);
  const auto behind = static_cast<std::int32_t>((now | 1u) - (timestamp | 1u));
  return behind * (3600.0 / 4294967296.0);
}

// A hand alone: its poses wait up to 200 ms, so that some are pending when the process stops.
TEST(Stopped, SendsNothingOldAsNewAfterwards) {
  const peer::SceneFile scene =
      scene_of(std::string(kTwoHandsOnAWall) + "\n[network]\nbundle = {hold = \"200 ms\"}\n");
  InProcess world(1);
  world.listen(scene);
  world.start(0, scene);
  world.run(1500);
  std::size_t states = 0;
  for (int stop = 0; stop < 8; ++stop) {
    world.run(330);
    world.heard().clear();
    world.clock().advance(seconds(3));
    world.run(300);
    for (const auto& state : world.heard_pdus<pdu::EntityState>()) {
      EXPECT_LT(age_of(state.header.timestamp, world.clock().utc_now()), 1.0) << stop;
      ++states;
    }
  }
  EXPECT_GT(states, 0u);
  EXPECT_GT(world.count(0, "stale_unsent"), 0u);
}

TEST(Stopped, DropsNothingOfItsOwnWhileItRuns) {
  const peer::SceneFile scene =
      scene_of(std::string(kTwoHandsOnAWall) + "\n[network]\nbundle = {hold = \"200 ms\"}\n");
  InProcess world(2);
  for (std::size_t link : {0u, 1u}) world.start(link, scene);
  world.run(10'000);
  for (std::size_t link : {0u, 1u}) {
    EXPECT_EQ(world.count(link, "stale_unsent"), 0u);
    EXPECT_EQ(world.count(link, "stale_datagrams"), 0u);
  }
}

}  // namespace
}  // namespace reckon::test
