// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Some seeds of the storm of unplugs; `./run fuzz unplugs` runs thousands.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "reckon/tests/fuzz/unplugs/trial.hpp"

namespace reckon::fuzz::unplugs {
namespace {

// Others than the first ones of the verb. Each has 100 faults, most of them unplugs.
constexpr std::uint64_t kFirst = 1'000'000, kSeeds = 20;

TEST(Unplugs, LeaveNoForceAndTheDeviceIsTakenUpAgain) {
  std::uint64_t pulled = 0, pressed = 0;
  for (std::uint64_t seed = kFirst; seed < kFirst + kSeeds; ++seed) {
    const Outcome outcome = try_out(plan_of(seed));
    ASSERT_FALSE(outcome.finding) << fmt::format("U{}: {}; again: ./run fuzz unplugs --replay {}",
                                                 outcome.finding->invariant,
                                                 outcome.finding->sentence, seed);
    pulled += outcome.received;
    pressed += outcome.pressed;
  }
  EXPECT_GT(pulled, 70 * kSeeds);
  EXPECT_GT(pressed, 8 * kSeeds) << "unplugged under a force";
}

TEST(Unplugs, RunTheSameFromTheSameSeed) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_EQ(try_out(plan_of(seed)).hash, try_out(plan_of(seed)).hash) << "seed " << seed;
  EXPECT_NE(try_out(plan_of(1)).hash, try_out(plan_of(2)).hash);
}

TEST(UnplugsPlan, DrawsEveryKindOfFaultInEveryPhase) {
  std::array<std::array<unsigned, kPhases>, kFaultKinds> drawn{};
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    for (const Fault& fault : plan_of(seed).faults)
      ++drawn[static_cast<std::size_t>(fault.kind)][static_cast<std::size_t>(fault.phase)];
  }
  for (const auto& phases : drawn) EXPECT_GT(*std::ranges::min_element(phases), 20U);
}

}  // namespace
}  // namespace reckon::fuzz::unplugs
