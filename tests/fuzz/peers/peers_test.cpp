// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Some seeds of the simulation of peers; `./run fuzz peers` runs thousands.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "reckon/tests/fuzz/peers/trial.hpp"
#include "reckon/tests/fuzz/search/seeded_test.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::fuzz {
namespace {

// Seeds that the verb does not try first.
constexpr std::uint64_t kFirst = 1'000'000;

std::uint64_t seeds() { return test::tries(80U, 300U); }

TEST(Peers, FindAndKeepEachOther) { expect_holds(kSimulation, kFirst, seeds()); }

TEST(Peers, RunTheSameFromTheSameSeed) {
  for (std::uint64_t seed = 1; seed <= test::tries(5U, 20U); ++seed)
    expect_same_again(kSimulation, seed);
  EXPECT_NE(try_out(plan_of(1)).hash, try_out(plan_of(2)).hash);
}

TEST(PeersPlan, DrawsEveryKindOfFaultInTime) {
  std::array<std::size_t, kFaultKinds> drawn{};
  std::size_t most = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Plan plan = plan_of(seed);
    most = std::max(most, plan.hosts.size());
    ASSERT_LE(plan.hosts.size(), kMostPeers);
    for (const Fault& fault : plan.faults) {
      ++drawn[static_cast<std::size_t>(fault.kind)];
      ASSERT_LE(fault.at, fault.until) << "seed " << seed;
      ASSERT_LE(fault.until, plan.faults_end) << "seed " << seed;
    }
  }
  EXPECT_GT(*std::min_element(drawn.begin(), drawn.end()), 50U);
  EXPECT_GT(most, 50U);
}

TEST(CountedTruth, CountsGapsCopiesAndLateOnes) {
  CountedTruth truth;
  using aoim::SequenceVerdict;
  const aoim::GroupIndex group{3};
  EXPECT_EQ(truth.note(9, group, 5), SequenceVerdict::first);
  EXPECT_EQ(truth.note(9, group, 9), SequenceVerdict::in_order);
  EXPECT_EQ(truth.note(9, group, 7), SequenceVerdict::late);
  EXPECT_EQ(truth.note(9, group, 7), SequenceVerdict::duplicate);
  EXPECT_EQ(truth.counts().lost, 2U);
  truth.forget(9);
  EXPECT_EQ(truth.note(9, group, 50), SequenceVerdict::first);
  EXPECT_EQ(truth.counts().lost, 2U);
  EXPECT_EQ(truth.counts().duplicated, 1U);
  EXPECT_EQ(truth.counts().reordered, 1U);
}

TEST(CountedTruth, HoldsAFarNumberUntilAnotherAgrees) {
  CountedTruth truth;
  using aoim::SequenceVerdict;
  const aoim::GroupIndex group{3};
  EXPECT_EQ(truth.note(9, group, 10), SequenceVerdict::first);
  EXPECT_EQ(truth.note(9, group, 1010), SequenceVerdict::leap);
  EXPECT_EQ(truth.counts().lost, 0U);
  EXPECT_EQ(truth.note(9, group, 1010), SequenceVerdict::duplicate);
  EXPECT_EQ(truth.note(9, group, 1012), SequenceVerdict::in_order);
  EXPECT_EQ(truth.counts().lost, 1000U);  // 11 to 1009, and 1011
  EXPECT_EQ(truth.note(9, group, 2'000'000), SequenceVerdict::leap);
  EXPECT_EQ(truth.note(9, group, 1'999'999), SequenceVerdict::late) << "another numbering";
  EXPECT_EQ(truth.counts().lost, 1000U);
  EXPECT_EQ(truth.note(9, group, 20), SequenceVerdict::too_old);
  EXPECT_EQ(truth.counts().leaps, 3U);
}

}  // namespace
}  // namespace reckon::fuzz
