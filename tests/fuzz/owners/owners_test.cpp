// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simulation of owners over many seeds.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "reckon/tests/fuzz/owners/trial.hpp"
#include "reckon/tests/fuzz/search/seeded_test.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::fuzz::owners {
namespace {

constexpr std::uint64_t kFirst = 1;

double share(std::vector<double>& values, double part) {
  std::sort(values.begin(), values.end());
  return values.empty()
             ? 0.0
             : values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

// Prints what the table of docs/robustness.md has.
TEST(Owners, AreOneWhateverTheNetworkDoes) {
  std::uint64_t hand_overs = 0, adoptions = 0;
  std::vector<double> gaps, calm_gaps, waits;
  expect_holds(kSimulation, kFirst, test::tries(100U, 10'000U),
               [&](const Plan&, const Outcome& outcome) {
                 hand_overs += outcome.hand_overs;
                 adoptions += outcome.adoptions;
                 auto& all = outcome.is_calm ? calm_gaps : gaps;
                 all.insert(all.end(), outcome.gaps.begin(), outcome.gaps.end());
                 if (outcome.is_calm)
                   waits.insert(waits.end(), outcome.waits.begin(), outcome.waits.end());
               });
  EXPECT_GT(hand_overs, 1000U);
  EXPECT_GT(adoptions, 50U);
  fmt::print(
      "{} hand-overs, {} adoptions; gap with faults p50 {:.0f}, p99 {:.0f}, most {:.0f} ms; "
      "without p50 {:.0f}, p99 {:.0f}, most {:.0f} ms; wait p50 {:.0f}, p99 {:.0f} ms\n",
      hand_overs, adoptions, 1e3 * share(gaps, 0.5), 1e3 * share(gaps, 0.99),
      1e3 * share(gaps, 1.0), 1e3 * share(calm_gaps, 0.5), 1e3 * share(calm_gaps, 0.99),
      1e3 * share(calm_gaps, 1.0), 1e3 * share(waits, 0.5), 1e3 * share(waits, 0.99));
}

TEST(Owners, RunTheSameFromTheSameSeed) {
  for (std::uint64_t seed = 1; seed <= test::tries(3U, 20U); ++seed)
    expect_same_again(kSimulation, seed);
  EXPECT_NE(try_out(plan_of(1), false).hash, try_out(plan_of(2), false).hash);
}

TEST(OwnersPlan, DrawsEveryKindOfFault) {
  std::array<std::size_t, kFaultKinds> drawn{};
  std::size_t contested = 0, moving = 0, large = 0, leaving = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const Plan plan = plan_of(seed);
    contested += plan.is_contested || plan.moves;
    moving += plan.moves;
    large += plan.island >= 20;
    leaving += plan.leaves_only;
    for (const Fault& fault : plan.faults) ++drawn[static_cast<std::size_t>(fault.kind)];
  }
  EXPECT_GT(*std::min_element(drawn.begin(), drawn.end()), 50U);
  EXPECT_EQ(contested, 1000U);
  EXPECT_GT(moving, 300U);
  EXPECT_GT(large, 3U);
  EXPECT_GT(leaving, 20U);
}

}  // namespace
}  // namespace reckon::fuzz::owners
