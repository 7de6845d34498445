// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/stamp_order.hpp"

#include <gmock/gmock.h>

#include <random>
#include <vector>

namespace reckon::tools {
namespace {

using std::chrono::milliseconds;

// Times [ms] and first octets of the written datagrams.
struct Written {
  std::vector<std::int64_t> times;
  std::vector<int> octets;
  StampOrder order{[this](const peer::SourceDatagram& datagram) {
    times.push_back(datagram.time / milliseconds(1));
    octets.push_back(std::to_integer<int>(datagram.bytes[0]));
  }};
  void add(std::int64_t time, int octet = 0) {
    const std::vector<std::byte> bytes(9, static_cast<std::byte>(octet));
    peer::SourceDatagram datagram;
    datagram.time = milliseconds(time);
    datagram.bytes = bytes;
    order.add(datagram);
  }
};

TEST(StampOrder, SortsDatagramsWithin200ms) {
  Written written;
  std::minstd_rand random(7);
  for (int i = 0; i < 5000; ++i) written.add(i - static_cast<int>(random() % 199), i % 256);
  written.order.flush();
  ASSERT_EQ(written.times.size(), 5000u);
  EXPECT_TRUE(std::ranges::is_sorted(written.times));
}

TEST(StampOrder, HoldsNoDatagramForLonger) {
  Written written;
  written.add(0);
  written.add(199);
  EXPECT_TRUE(written.times.empty());
  written.add(200);
  EXPECT_THAT(written.times, testing::ElementsAre(0));
}

TEST(StampOrder, KeepsTheOrderOfEqualTimes) {
  Written written;
  for (int i = 0; i < 100; ++i) written.add(5, i);
  written.order.flush();
  EXPECT_TRUE(std::ranges::is_sorted(written.octets));
  EXPECT_EQ(written.octets.size(), 100u);
}

TEST(StampOrder, WritesADatagramThatIsTooLate) {
  Written written;
  written.add(1000);
  written.add(0);
  EXPECT_THAT(written.times, testing::ElementsAre(0));
}

TEST(StampOrder, HoldsABoundedNumber) {
  Written written;
  for (std::size_t i = 0; i < StampOrder::kMost + 10; ++i) written.add(1);
  EXPECT_EQ(written.order.held(), StampOrder::kMost);
}

}  // namespace
}  // namespace reckon::tools
