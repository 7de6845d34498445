// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Some seeds of the simulation of leaders; `./run fuzz leaders` runs thousands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "reckon/tests/fuzz/leaders/trial.hpp"
#include "reckon/tests/fuzz/search/seeded_test.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::fuzz::leaders {
namespace {

// Seeds that the verb does not try first.
constexpr std::uint64_t kFirst = 1'000'000;

std::uint64_t seeds() { return test::tries(80U, 300U); }

TEST(Leaders, OneLeaderPerCellIntroducesNewcomers) { expect_holds(kSimulation, kFirst, seeds()); }

// Old failures: absences shorter than a check, maps that waited while their reader slept, parts of
// snapshots that a newcomer could not take, heirs with incomplete states.
TEST(Leaders, HoldWhereTheyOnceDidNot) {
  for (const std::uint64_t seed :
       {14281U, 20520U, 10649U, 12761U, 14727U, 17585U, 9540U, 6447U, 22065U, 15348U}) {
    expect_holds(kSimulation, seed, 1);
  }
}

TEST(Leaders, RunTheSameFromTheSameSeed) {
  for (std::uint64_t seed = 1; seed <= test::tries(5U, 10U); ++seed)
    expect_same_again(kSimulation, seed);
  EXPECT_NE(try_out(plan_of(1)).hash, try_out(plan_of(2)).hash);
}

TEST(LeadersPlan, DrawsEveryKindOfFault) {
  std::array<std::size_t, kFaultKinds> drawn{};
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const Plan plan = plan_of(seed);
    ASSERT_LE(plan.hosts.size(), kMostHosts);
    for (const Fault& fault : plan.faults) {
      ++drawn[static_cast<std::size_t>(fault.kind)];
      if (!is_forgery(fault.kind)) {
        ASSERT_LE(fault.until, plan.calm) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(*std::min_element(drawn.begin(), drawn.end()), 50U);
}

}  // namespace
}  // namespace reckon::fuzz::leaders
