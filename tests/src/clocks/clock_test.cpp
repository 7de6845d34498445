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

TEST(ManualClock, MovesOnlyWhenToldTo) {
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

TEST(SteadyClock, TellsUtcOfThisCentury) {
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
  counters.for_each([&](auto name, auto meaning, std::uint64_t) {
    EXPECT_EQ(meaning, name == "a" ? "the first" : "filler");
    names.emplace_back(name);
  });
  ASSERT_EQ(names.size(), 101u);
  EXPECT_EQ(names.front(), "a");
  EXPECT_EQ(names.back(), "99");
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
