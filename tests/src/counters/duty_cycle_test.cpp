// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/counters/duty_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// Compares with a sorted list; the buckets may round up by 1/32.
void expect_percentiles_of(std::vector<std::int64_t> values) {
  DurationHistogram histogram;
  for (const std::int64_t value : values) histogram.add(nanoseconds{value});
  std::sort(values.begin(), values.end());
  for (const double share : {0.0, 0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = std::max(std::ceil(share * static_cast<double>(values.size())), 1.0);
    const std::int64_t exact = values[static_cast<std::size_t>(rank) - 1];
    const std::int64_t told = histogram.percentile(share).count();
    EXPECT_GE(told, exact) << share;
    EXPECT_LE(static_cast<double>(told), static_cast<double>(exact) * (1.0 + 1.0 / 32.0)) << share;
  }
  EXPECT_EQ(histogram.max().count(), values.back());
  EXPECT_EQ(histogram.count(), values.size());
}

TEST(DurationHistogram, AgreesWithSortingWithinOneThirtySecond) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> lateness(10.0, 2.0);
  std::uniform_int_distribution<std::int64_t> even(0, 1'000'000), small(0, 40);
  std::vector<std::int64_t> a, b, c;
  for (int i = 0; i < 100'000; ++i) {
    a.push_back(static_cast<std::int64_t>(lateness(random)));
    b.push_back(even(random));
    c.push_back(small(random));
  }
  expect_percentiles_of(a);
  expect_percentiles_of(b);
  expect_percentiles_of(c);
  expect_percentiles_of({17});
  expect_percentiles_of({0, 0, 0});
}

TEST(DurationHistogram, AgreesAtEveryPowerOfTwo) {
  for (int exponent = 0; exponent < 40; ++exponent) {
    const std::int64_t edge = std::int64_t{1} << exponent;
    expect_percentiles_of({std::max<std::int64_t>(edge - 1, 0), edge, edge + 1});
  }
}

TEST(DurationHistogram, TakesAnyDuration) {
  DurationHistogram histogram;
  histogram.add(-5ns);
  EXPECT_EQ(histogram.max(), 0ns);
  histogram.add(nanoseconds::max());
  EXPECT_EQ(histogram.percentile(1.0), nanoseconds::max());
  EXPECT_EQ(histogram.percentile(0.5), 0ns);
}

TEST(DurationHistogram, IsZeroWhileEmpty) {
  const DurationHistogram histogram;
  const Percentiles all = percentiles(histogram);
  EXPECT_EQ(all.p50, 0ns);
  EXPECT_EQ(all.max, 0ns);
}

TEST(DutyCycle, CountsLatenessStepsMissesAndOverruns) {
  DutyCycle cycle(1ms);
  cycle.record(0ms, 10us, 60us);                // on time
  cycle.record(1ms, 1ms + 200us, 2ms);          // ends just when the next is due
  cycle.record(2ms, 2ms + 100us, 3ms + 1us);    // overruns
  cycle.record(3ms, 6ms + 500us, 6ms + 510us);  // 3.5 ms late: three periods missed
  EXPECT_EQ(cycle.steps(), 4u);
  EXPECT_EQ(cycle.missed(), 4u) << "the one that is due while another overruns has no step";
  EXPECT_EQ(cycle.overruns(), 2u);
  EXPECT_EQ(cycle.lateness().max(), 3500us);
  EXPECT_EQ(cycle.step_time().max(), 901us);
}

TEST(DutyCycle, CountsAnEarlyStepAsPunctual) {
  DutyCycle cycle(1ms);
  cycle.record(5ms, 4ms, 4ms + 100us);
  EXPECT_EQ(cycle.lateness().max(), 0ns);
  EXPECT_EQ(cycle.missed(), 0u);
}

TEST(DutyCycle, RecordsWithoutAllocating) {
  DutyCycle cycle(1ms);
  const test::AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) cycle.record(i * 1ms, i * 1ms + 5us, i * 1ms + 30us);
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_EQ(cycle.steps(), 1000u);
}

TEST(PassTimes, CountsPassesThatTakeLongerThanTheLimit) {
  PassTimes passes(1ms);
  passes.record(5ms, 5ms + 20us);
  passes.record(7ms, 8ms);         // exactly the limit
  passes.record(9ms, 11ms + 4us);  // longer
  EXPECT_EQ(passes.times().count(), 3u);
  EXPECT_EQ(passes.overruns(), 1u);
  EXPECT_EQ(passes.times().max(), 2004us);
}

}  // namespace
}  // namespace reckon::peer
