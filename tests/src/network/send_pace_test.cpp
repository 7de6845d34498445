// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/send_pace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// A wire that sends datagrams one after another, each charged with `charge` octets in the kernel.
class Wire {
 public:
  explicit Wire(nanoseconds each) : each_(each) {}

  /// Offers a datagram at `now`; returns its queueing delay, or zero if it is held back.
  nanoseconds offer(SendPace& pace, nanoseconds now) {
    while (!leaving_.empty() && leaving_.front() <= now) leaving_.pop_front();
    const std::size_t queued = leaving_.size() * kCharge;
    if (!pace.may_send(queued, now)) {
      ++held_;
      return 0ns;
    }
    if (queued > 0) pace.sent(kCharge);
    leaving_.push_back(std::max(now, leaving_.empty() ? now : leaving_.back()) + each_);
    ++sent_;
    return leaving_.back() - now;
  }
  [[nodiscard]] int sent() const { return sent_; }
  [[nodiscard]] int held() const { return held_; }

 private:
  static constexpr std::size_t kCharge = 2304;
  nanoseconds each_;
  std::deque<nanoseconds> leaving_;
  int sent_ = 0, held_ = 0;
};

// 1400 octets take 11.2 ms at 1 Mb/s; a datagram is offered every 3 ms.
TEST(SendPace, KeepsTheQueueShortOnASlowWire) {
  SendPace pace;
  Wire wire(11'200us);
  nanoseconds longest{0};
  for (nanoseconds now = 1s; now < 11s; now += 3ms) {
    longest = std::max(longest, wire.offer(pace, now));
  }
  EXPECT_LE(longest, SendPace::kLongest + 2 * 11'200us);
  EXPECT_GT(longest, SendPace::kLongest / 2);
  EXPECT_NEAR(wire.sent(), 10.0 / 0.0112, 20);  // the wire never idles because of the pace
}

TEST(SendPace, HoldsNothingBackOnAFastWire) {
  SendPace pace;
  Wire wire(2900us);
  for (nanoseconds now = 1s; now < 11s; now += 3ms) wire.offer(pace, now);
  EXPECT_EQ(wire.held(), 0);
}

TEST(SendPace, PassesABurstFasterThanTheWire) {
  SendPace pace;
  Wire wire(11us);
  for (nanoseconds burst = 1s; burst < 3s; burst += 10ms) {
    for (nanoseconds now = burst; now < burst + 600us; now += 6us) wire.offer(pace, now);
  }
  EXPECT_EQ(wire.held(), 0);
}

// Other threads of the host keep the kernel from its queue for 40 ms; the queue then empties.
TEST(SendPace, HoldsNothingBackOnABusyHost) {
  SendPace pace;
  std::size_t queued = 0;
  for (nanoseconds now = 0ms; now <= 40ms; now += 5ms) {
    EXPECT_TRUE(pace.may_send(queued, now));
    if (queued > 0) pace.sent(2304);
    queued += 2304;
  }
  EXPECT_TRUE(pace.may_send(0, 45ms));
}

TEST(SendPace, HoldsBackOnAWireThatTakesNothing) {
  SendPace pace;
  std::size_t queued = 0;
  int held = 0;
  for (nanoseconds now = 0ms; now < 200ms; now += 5ms) {
    if (!pace.may_send(queued, now)) {
      ++held;
      continue;
    }
    if (queued > 0) pace.sent(2304);
    queued += 2304;
  }
  EXPECT_EQ(held, 29);  // from 55 ms on: the pace counts the first datagram as waiting since 5 ms
}

TEST(SendPace, FollowsAWireThatChangesItsSpeed) {
  SendPace pace;
  Wire slow(11'200us);
  for (nanoseconds now = 1s; now < 3s; now += 3ms) slow.offer(pace, now);
  ASSERT_GT(slow.held(), 0);
  Wire fast(1ms);
  for (nanoseconds now = 4s; now < 6s; now += 3ms) fast.offer(pace, now);
  EXPECT_EQ(fast.held(), 0);
}

}  // namespace
}  // namespace reckon::peer
