// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/network_read_loop.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "reckon/tests/src/support/manual_link.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

const GroupPool kPool = GroupPool::ipv4_default();
constexpr std::uint32_t kWaiting = 10'000;

// Of many lengths, with its number in front.
std::vector<std::byte> numbered(std::uint32_t number) {
  std::vector<std::byte> octets(4 + number * 7919 % 3000);
  std::memcpy(octets.data(), &number, sizeof number);
  return octets;
}

class ReadLoop : public ::testing::Test {
 protected:
  // The model loop takes up to `most`, in order and whole.
  void take(std::size_t most) {
    for (std::size_t i = 0; i < most; ++i) {
      const QueuedDatagram* datagram = ring_.front();
      if (datagram == nullptr) return;
      ASSERT_EQ(datagram->octets.size(), numbered(taken_).size());
      std::uint32_t number = 0;
      std::memcpy(&number, datagram->octets.data(), sizeof number);
      ASSERT_EQ(number, taken_);
      ASSERT_EQ(datagram->group, kPool.address(number % 5));
      ring_.pop();
      ++taken_;
    }
  }

  test::ManualLink link_;
  haptics::SpscRing<GroupCommand> commands_{16};
  DatagramRing ring_{std::size_t{128} << 10};
  Counters counters_;
  NetworkReadLoop loop_{link_, commands_, ring_, counters_};
  std::uint32_t taken_ = 0;
};

TEST_F(ReadLoop, LeavesInTheLinkWhatTheModelLoopHasNoRoomFor) {
  for (std::uint32_t i = 0; i < kWaiting; ++i) link_.put(kPool.address(i % 5), numbered(i));
  std::size_t read = loop_.step(nanoseconds(1));
  EXPECT_GT(read, 30u);
  EXPECT_TRUE(loop_.is_full());
  EXPECT_EQ(link_.waiting(), kWaiting - read);

  // The model loop stalls: nothing more is taken, but groups are joined and left.
  ASSERT_TRUE(commands_.push({kPool.address(3), true}));
  ASSERT_TRUE(commands_.push({kPool.address(4), true}));
  ASSERT_TRUE(commands_.push({kPool.address(3), false}));
  EXPECT_EQ(loop_.step(nanoseconds(2)), 0u);
  EXPECT_EQ(link_.joined(), std::vector{kPool.address(4)});
  EXPECT_EQ(link_.waiting(), kWaiting - read);

  // It goes on, by fits and starts: all come, each once, in order.
  for (std::size_t turn = 0; taken_ < kWaiting; ++turn) {
    ASSERT_LT(turn, 100'000u);
    take(turn * turn % 40);
    if (HasFatalFailure()) return;
    read += loop_.step(nanoseconds(3));
  }
  EXPECT_EQ(read, kWaiting);
  EXPECT_EQ(link_.waiting(), 0u);
  EXPECT_FALSE(loop_.is_full());
  EXPECT_EQ(counters_.find("datagrams_in")->value(), kWaiting);
  EXPECT_GT(counters_.find("read_waits")->value(), 10u);
}

TEST_F(ReadLoop, SaysThatItIsFullOnlyWhileItIs) {
  EXPECT_EQ(loop_.step(nanoseconds(1)), 0u);
  EXPECT_FALSE(loop_.is_full());
  EXPECT_EQ(counters_.find("read_waits")->value(), 0u);
  for (std::uint32_t i = 0; i < 200; ++i) link_.put(kPool.address(i % 5), numbered(i));
  while (!loop_.is_full()) ASSERT_GT(loop_.step(nanoseconds(1)), 0u);
  while (taken_ < 200) {
    take(200);
    if (HasFatalFailure()) return;
    static_cast<void>(loop_.step(nanoseconds(1)));
  }
  EXPECT_FALSE(loop_.is_full());
}

}  // namespace
}  // namespace reckon::peer
