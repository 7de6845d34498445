// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The histogram of jumps, compared with sorted lists.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "reckon/pdu/management/entity_request.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"
#include "reckon/tools/listener/contact_forces.hpp"
#include "reckon/tools/listener/entity_table.hpp"

namespace reckon::tools::jump_histogram_test {
namespace {

TEST(JumpHistogram, GivesPercentilesWithinItsBuckets) {
  std::mt19937 random(7);
  std::lognormal_distribution<double> sizes(-2, 2.5);
  JumpHistogram histogram;
  std::vector<double> sorted;
  for (int i = 0; i < 20'000; ++i) {
    sorted.push_back(sizes(random));
    histogram.add(sorted.back());
  }
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(histogram.count(), sorted.size());
  EXPECT_FLOAT_EQ(static_cast<float>(histogram.max()), static_cast<float>(sorted.back()));
  for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * 20'000.0)) - 1;
    const double found = histogram.percentile(share);
    EXPECT_GE(found, sorted[rank] * (1 - 1e-6)) << share;
    EXPECT_LE(found, sorted[rank] * 1.1251) << share;
  }
}

TEST(JumpHistogram, TakesAnyNumber) {
  JumpHistogram histogram;
  EXPECT_EQ(histogram.percentile(0.5), 0);
  for (const double size : {-1.0, 0.0, std::nan(""), 1e-7}) histogram.add(size);
  EXPECT_EQ(histogram.percentile(1), 0);
  histogram.add(HUGE_VAL);
  histogram.add(1e300);
  EXPECT_GT(histogram.percentile(1), 1e6);
}

TEST(JumpHistogram, KeepsItsShapeWhereABucketIsFull) {
  JumpHistogram histogram;
  for (int i = 0; i < 300'000; ++i) histogram.add(i % 100 == 0 ? 8.0 : 1.0);
  EXPECT_EQ(histogram.count(), 300'000U);
  EXPECT_NEAR(histogram.percentile(0.5), 1.0, 0.126);
  EXPECT_NEAR(histogram.percentile(0.97), 1.0, 0.126);
  EXPECT_EQ(histogram.percentile(0.999), 8.0);
}

}  // namespace
}  // namespace reckon::tools::jump_histogram_test
