// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/clock.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/peer/counters/counters.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

TEST(ManualClock, MovesOnlyByHand) {
  ManualClock clock(5s, 100s);
  EXPECT_EQ(clock.now(), 5s);
  EXPECT_EQ(clock.utc_now(), 105s);
  clock.advance(1ms);
  EXPECT_EQ(clock.now(), 5001ms);
  clock.set(7s);
  EXPECT_EQ(clock.now(), 7s);
  EXPECT_EQ(clock.utc_now(), 107s);
}

TEST(SteadyClock, NeverStepsBack) {
  const SteadyClock clock;
  std::chrono::nanoseconds last = clock.now();
  for (int i = 0; i < 10000; ++i) {
    const std::chrono::nanoseconds now = clock.now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(SteadyClock, ReturnsUtcOfThisCentury) {
  const auto years = std::chrono::duration_cast<std::chrono::years>(SteadyClock{}.utc_now());
  EXPECT_GT(years.count(), 50);
  EXPECT_LT(years.count(), 130);
}

TEST(Counters, KeepNamesInOrderAndReferencesValid) {
  Counters counters;
  Counter& first = counters.make("a", "the first");
  for (int i = 0; i < 100; ++i) (void)counters.make(std::to_string(i), "filler");
  first.add(3);
  EXPECT_EQ(&counters.make("a", "said again"), &first);
  EXPECT_EQ(counters.find("a")->value(), 3u);
  EXPECT_EQ(counters.find("none"), nullptr);
  std::vector<std::string> names;
  counters.for_each([&](const CounterReading& reading) {
    EXPECT_EQ(reading.meaning, reading.name == "a" ? "the first" : "filler");
    names.emplace_back(reading.name);
  });
  ASSERT_EQ(names.size(), 101u);
  EXPECT_EQ(names.front(), "a");
  EXPECT_EQ(names.back(), "99");
}

TEST(Counters, KeepTheFirstDescription) {
  static constexpr CounterGroup kGroup{"refused", "cause", "what was refused"};
  Counters counters;
  (void)counters.make("late_in", "came late");
  (void)counters.make_in(kGroup, "late", "late_in", "came late");
  (void)counters.make_level("led", "of now");
  (void)counters.make("led", "of now");
  std::vector<CounterReading> readings;
  counters.for_each([&](const CounterReading& reading) { readings.push_back(reading); });
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[0].group, &kGroup);
  EXPECT_EQ(readings[0].member, "late");
  EXPECT_FALSE(readings[0].is_level);
  EXPECT_EQ(readings[1].group, nullptr);
  EXPECT_TRUE(readings[1].is_level);
}

TEST(Counters, AddWithoutAllocating) {
  Counters counters;
  Counter& counter = counters.make("a", "b");
  const test::AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) counter.add();
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_EQ(counter.value(), 1000u);
}

}  // namespace
}  // namespace reckon::peer
