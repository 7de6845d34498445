// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/network_read_loop.hpp"

#include <gtest/gtest.h>

#include "reckon/peer/network/simulated_network.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(NetworkReadLoop, TriesAGroupThatWasRefusedAgainUntilItIsJoinedOrNotWanted) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.max_groups = 2;
  SimulatedNetwork network(options, clock);
  haptics::SpscRing<GroupCommand> commands(16);
  haptics::SpscRing<InboundDatagram> inbound(16);
  Counters counters;
  NetworkReadLoop loop(network.link(0), commands, inbound, counters);
  const auto count = [&](const char* name) { return counters.find(name)->value(); };
  const GroupPool pool = GroupPool::ipv4_default();
  for (std::size_t i = 0; i < 5; ++i) static_cast<void>(commands.push({pool.address(i), true}));
  loop.step(seconds(1));
  EXPECT_EQ(count("join_errors"), 3u);
  EXPECT_EQ(count("groups_unjoined"), 3u);

  // One is not wanted any more; one place becomes free.
  static_cast<void>(commands.push({pool.address(4), false}));
  static_cast<void>(commands.push({pool.address(0), false}));
  loop.step(seconds(1) + milliseconds(999));
  EXPECT_EQ(count("groups_unjoined"), 2u);
  loop.step(seconds(2));
  EXPECT_EQ(count("groups_unjoined"), 1u);
  static_cast<void>(commands.push({pool.address(1), false}));
  loop.step(seconds(2) + milliseconds(1));
  EXPECT_EQ(count("groups_unjoined"), 1u) << "not more often than each second";
  loop.step(seconds(3));
  EXPECT_EQ(count("groups_unjoined"), 0u);
  EXPECT_EQ(count("join_errors"), 3u);

  // Groups 2 and 3 are what is heard.
  const std::byte octet{1};
  for (std::size_t i = 0; i < 5; ++i) network.link(1).send(pool.address(i), {&octet, 1});
  loop.step(seconds(3));
  for (const std::size_t expected : {2u, 3u}) {
    ASSERT_NE(inbound.front(), nullptr);
    EXPECT_EQ(inbound.front()->group, pool.address(expected));
    inbound.pop();
  }
  EXPECT_EQ(inbound.front(), nullptr);
}

}  // namespace
}  // namespace reckon::peer
