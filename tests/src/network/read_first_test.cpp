// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Groups whose sockets are read before all others.
#include <gtest/gtest.h>

#include <algorithm>

#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;

// Groups 10 to 13 are read first.
UdpMulticastOptions reads_first() {
  UdpMulticastOptions options = on("lo");
  options.read_first = GroupPool(group(9), 4);
  return options;
}

class ReadFirst : public testing::Test {
 protected:
  ReadFirst() {
    for (const int number : {1, 2, 3, 4, 10, 11}) EXPECT_FALSE(join(number));
  }
  std::error_code join(int number) { return link_.join(group(static_cast<std::uint8_t>(number))); }
  void say(int number, int times) {
    const GroupAddress to = group(static_cast<std::uint8_t>(number));
    for (int i = 0; i < times; ++i) EXPECT_TRUE(other_.send(to, octets("word")));
  }
  /// Counts the datagrams of a batch from the groups that are read first.
  static std::ptrdiff_t of_first(std::span<const Datagram> batch) {
    return std::count_if(batch.begin(), batch.end(), [](const Datagram& datagram) {
      return datagram.group == group(10) || datagram.group == group(11);
    });
  }

  UdpMulticast other_{on("lo"), kClock};
  UdpMulticast link_{reads_first(), kClock};
  std::array<Datagram, 32> batch_;
};

TEST_F(ReadFirst, ComesBeforeAllThatWaitsInOtherGroups) {
  for (const int number : {1, 2, 3, 4}) say(number, 100);
  say(10, 2);
  say(11, 1);
  ASSERT_TRUE(link_.wait(1s));
  ASSERT_EQ(link_.receive(batch_), batch_.size());
  EXPECT_EQ(of_first(std::span(batch_).first(3)), 3);
  say(10, 1);  // while others are being read
  ASSERT_EQ(link_.receive(batch_), batch_.size());
  EXPECT_EQ(batch_[0].group, group(10));
  EXPECT_EQ(hear(link_).size(), 400u + 4u - 64u) << "nothing is left behind";
}

TEST_F(ReadFirst, LeavesHalfOfABatchToTheOthers) {
  for (const int number : {1, 10, 11}) say(number, 200);
  ASSERT_TRUE(link_.wait(1s));
  ASSERT_EQ(link_.receive(batch_), batch_.size());
  EXPECT_EQ(of_first(batch_), 16);
  EXPECT_EQ(hear(link_).size(), 600u - 32u);
}

TEST_F(ReadFirst, WakesAndFillsABatchAlone) {
  EXPECT_FALSE(link_.wait(0s));
  say(10, 40);
  ASSERT_TRUE(link_.wait(1s));
  EXPECT_EQ(link_.receive(batch_), batch_.size());
  EXPECT_EQ(hear(link_).size(), 8u);
  EXPECT_FALSE(link_.wait(0s)) << "nothing waits any more";
}

TEST_F(ReadFirst, IsLeftAndJoinedAgain) {
  link_.leave(group(10));
  say(10, 5);
  EXPECT_TRUE(hear(link_, 5ms).empty());
  EXPECT_FALSE(link_.join(group(10)));
  say(10, 5);
  EXPECT_EQ(hear(link_).size(), 5u);
}

}  // namespace
}  // namespace reckon::peer
