// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/all_cores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace reckon::bench {
namespace {

TEST(AllCores, DoesEachJobOnce) {
  std::vector<int> done(1000);
  EXPECT_TRUE(run_on_all_cores(done.size(),
                               [&](std::size_t i, const std::atomic<bool>&) { ++done[i]; }, {}));
  EXPECT_TRUE(std::ranges::all_of(done, [](int times) { return times == 1; }));
}

TEST(AllCores, HasNothingToDoForNoJobs) {
  EXPECT_TRUE(run_on_all_cores(0, [](std::size_t, const std::atomic<bool>&) { FAIL(); }, {}));
}

TEST(AllCores, StopsRunningJobsOnRequest) {
  EXPECT_FALSE(run_on_all_cores(
      4,
      [](std::size_t, const std::atomic<bool>& stop) {
        while (!stop) {
        }
      },
      [](std::size_t) { return false; }));
}

TEST(AllCores, CallRethrowsTheFaultOfAJob) {
  EXPECT_THROW(run_on_all_cores(100,
                                [](std::size_t i, const std::atomic<bool>&) {
                                  if (i == 7) throw std::runtime_error("seventh");
                                },
                                {}),
               std::runtime_error);
}

}  // namespace
}  // namespace reckon::bench
