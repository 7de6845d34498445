// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/statistics/quantile.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "reckon/peer/counters/duty_cycle.hpp"

namespace reckon::bench {
namespace {

TEST(Quantile, IsTheLeastValueReachingTheShare) {
  std::vector<double> values{40, 10, 30, 20};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 0.25), 10);
  EXPECT_EQ(quantile(values, 0.26), 20);
  EXPECT_EQ(quantile(values, 0.99), 40);
  EXPECT_EQ(quantile(values, 1), 40);
  std::vector<double> none;
  EXPECT_EQ(quantile(none, 0.5), 0);
}

// Below 32 ns each number has a bucket of its own.
TEST(Quantile, MatchesTheHistogram) {
  std::vector<double> values;
  peer::DurationHistogram histogram;
  for (int i = 0; i < 31; ++i) {
    values.push_back(i * 7 % 31);
    histogram.add(std::chrono::nanoseconds(i));
  }
  for (const double share : {0.01, 0.1, 0.5, 0.9, 0.95})
    EXPECT_EQ(quantile(values, share), static_cast<double>(histogram.percentile(share).count()))
        << share;
}

TEST(Median, IsInTheMiddle) {
  std::vector<double> odd{5, 1, 3}, even{4, 1, 3, 10}, none;
  EXPECT_EQ(median(odd), 3);
  EXPECT_EQ(median(even), 3.5);
  EXPECT_EQ(median(none), 0);
}

}  // namespace
}  // namespace reckon::bench
