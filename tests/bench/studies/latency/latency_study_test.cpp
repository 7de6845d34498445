// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/latency/latency_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace reckon::bench {
namespace {

using std::chrono::nanoseconds;

// Two peers with threads and sockets on loopback. The test does not judge times; they depend on the
// machine.
TEST(LatencyStudy, MeasuresTouchesAndServoSteps) {
  LatencyOptions options;
  options.length = kShortestLatencyStudy;
  const Latencies found = measure_latency(options, tools::Console{});
  EXPECT_FALSE(found.there.empty());
  ASSERT_FALSE(found.touch.empty());
  EXPECT_GT(*std::min_element(found.touch.begin(), found.touch.end()), nanoseconds{0});
  ASSERT_FALSE(found.servo_steps.empty());
  EXPECT_GT(*std::min_element(found.servo_steps.begin(), found.servo_steps.end()), nanoseconds{0});
  EXPECT_GT(found.servo_steps.size(), found.touch.size());
}

}  // namespace
}  // namespace reckon::bench
