// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/wake_signal.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

TEST(WakeSignal, EndsTheNextWaitOnce) {
  WakeSignal signal;
  EXPECT_FALSE(signal.wait(0ns));
  signal.notify();
  EXPECT_TRUE(signal.wait(nanoseconds::max()));
  EXPECT_FALSE(signal.wait(0ns));
}

TEST(WakeSignal, ManyNotificationsBeforeAWaitAreOne) {
  WakeSignal signal;
  for (int i = 0; i < 1000; ++i) signal.notify();
  EXPECT_TRUE(signal.wait(0ns));
  EXPECT_FALSE(signal.wait(0ns));
}

TEST(WakeSignal, WaitsNoLongerThanItsTimeout) {
  WakeSignal signal;
  EXPECT_FALSE(signal.wait(1ms));
  EXPECT_FALSE(signal.wait(-1s));
  EXPECT_FALSE(signal.wait(nanoseconds::min()));
}

// Each side waits without a time-out until the other has moved: a lost notification would hang the
// test.
TEST(WakeSignal, LosesNoNotificationBetweenTwoThreads) {
  constexpr int kRounds = 20'000;
  WakeSignal there, back;
  int ball = 0;  // not atomic: a value written before notify() is visible after wait()
  const auto wait_for = [&](WakeSignal& signal) {
    while (!signal.wait(nanoseconds::max())) {
    }
  };
  std::thread other([&] {
    for (int i = 0; i < kRounds; ++i) {
      wait_for(there);
      ++ball;
      back.notify();
    }
  });
  for (int i = 0; i < kRounds; ++i) {
    ASSERT_EQ(ball, i);
    there.notify();
    wait_for(back);
  }
  other.join();
  EXPECT_EQ(ball, kRounds);
}

// The waiter reads the number after each wait, as a loop reads its ring.
TEST(WakeSignal, LosesTheNewestOfManyNotifiersToNobody) {
  WakeSignal signal;
  std::atomic<int> number{0};
  constexpr int kEach = 50'000;
  std::thread first([&] {
    for (int i = 0; i < kEach; ++i) number.fetch_add(1), signal.notify();
  });
  std::thread second([&] {
    for (int i = 0; i < kEach; ++i) number.fetch_add(1), signal.notify();
  });
  while (number.load() < 2 * kEach) signal.wait(nanoseconds::max());
  first.join();
  second.join();
  EXPECT_EQ(number.load(), 2 * kEach);
}

}  // namespace
}  // namespace reckon::peer
