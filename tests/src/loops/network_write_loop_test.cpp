// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/network_write_loop.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

using namespace test;

TEST(NetworkWriteLoop, SendsQueuedDatagramsInOneBatch) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  DatagramRing ring(std::size_t{2} << 20);
  Counters counters;
  NetworkWriteLoop loop(a, ring, counters);
  std::vector<std::string> sent;
  for (int i = 0; i < 50; ++i) {
    sent.emplace_back(1300, static_cast<char>('0' + i));
    ASSERT_TRUE(ring.push(group(1), {}, octets(sent.back())));
  }
  EXPECT_EQ(loop.step(), 50u);
  EXPECT_TRUE(ring.empty());
  EXPECT_EQ(a.statistics().send_calls, 1u);
  EXPECT_EQ(counters.find("datagrams_out")->value(), 50u);
  EXPECT_EQ(counters.find("octets_out")->value(), 65'000u);
  EXPECT_EQ(hear(b), sent);
}

TEST(NetworkWriteLoop, CountsRefusedDatagramsAndSendsTheRest) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  DatagramRing ring(std::size_t{2} << 20);
  Counters counters;
  NetworkWriteLoop loop(a, ring, counters);
  ASSERT_TRUE(ring.push(group(1), {}, octets("before")));
  ASSERT_TRUE(ring.push(IpEndpoint::v4(0xefc04e01, 0), {}, octets("to no port")));
  ASSERT_TRUE(ring.push(group(1), {}, octets("after")));
  EXPECT_EQ(loop.step(), 3u);
  EXPECT_EQ(counters.find("send_errors")->value(), 1u);
  EXPECT_EQ(counters.find("datagrams_out")->value(), 2u);
  EXPECT_EQ(hear(b), (std::vector<std::string>{"before", "after"}));
}

}  // namespace
}  // namespace reckon::peer
