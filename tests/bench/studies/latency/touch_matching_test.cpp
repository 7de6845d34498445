// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/latency/touch_matching.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "reckon/bench/studies/latency/latency_study.hpp"

namespace reckon::bench {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// One force a millisecond, at 0.5, 1.5, .. ms.
std::vector<StepSample> forces(std::initializer_list<double> values) {
  std::vector<StepSample> out;
  for (const double value : values) out.push_back({500us + out.size() * 1ms, value});
  return out;
}

TEST(TouchMatching, GivesTheTimeToTheFirstChangedStep) {
  const std::vector<StepSample> changes{{0ms, 1.2}, {2ms, 1.8}, {6ms, 1.2}};
  const TouchTimes times =
      match_touches(changes, forces({1.2, 1.21, 1.22, 1.7, 1.8, 1.8, 1.8, 1.3, 1.2}));
  EXPECT_EQ(times.taken, (std::vector<nanoseconds>{1500us, 1500us}));
  EXPECT_EQ(times.missed, 0u);
}

TEST(TouchMatching, IgnoresNoiseAroundTheOldValue) {
  const std::vector<StepSample> changes{{0ms, 1.2}, {1ms, 1.8}};
  const TouchTimes times = match_touches(changes, forces({1.2, 1.49, 1.1, 1.51}));
  EXPECT_EQ(times.taken, std::vector<nanoseconds>{2500us});
}

TEST(TouchMatching, CountsMissedAndLateChanges) {
  const std::vector<StepSample> late{{0ms, 1.2}, {1ms, 1.8}, {3ms, 1.2}};
  EXPECT_EQ(match_touches(late, forces({1.2, 1.2, 1.2, 1.8, 1.2})).missed, 2u);
  const std::vector<StepSample> never{{0ms, 1.2}, {1ms, 1.8}};
  EXPECT_EQ(match_touches(never, forces({1.2, 1.2, 1.2})).missed, 1u);
  EXPECT_EQ(match_touches(never, {}).missed, 1u);
  EXPECT_EQ(match_touches({}, forces({1.2})).missed, 0u);
}

TEST(TouchMatching, IgnoresAForcePresentBeforeTheChange) {
  const std::vector<StepSample> changes{{0ms, 1.2}, {2ms, 1.8}};
  const TouchTimes times = match_touches(changes, forces({1.2, 1.7, 1.8, 1.8}));
  EXPECT_TRUE(times.taken.empty());
  EXPECT_EQ(times.missed, 1u);
}

TEST(TouchMatching, PercentilesMatchTheSortedList) {
  std::vector<nanoseconds> times;
  for (int i = 1000; i > 0; --i) times.push_back(i * 1us);
  const peer::Spread spread = spread_us(times);
  EXPECT_EQ(spread.p50, 500);
  EXPECT_EQ(spread.p99, 990);
  EXPECT_EQ(spread.p999, 999);
  EXPECT_EQ(spread.max, 1000);
  EXPECT_EQ(spread_us({}).max, 0);
  EXPECT_EQ(spread_us({7us}).p50, 7);
}

}  // namespace
}  // namespace reckon::bench
