// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common expectations of the tests of seeded simulations.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz {

/// Fails at the first of `count` seeds that breaks an invariant.
/// @param see called with (plan, outcome) of each other seed
template <typename Plan, typename Outcome, typename See>
void expect_holds(const SeededSimulation<Plan, Outcome>& simulation, std::uint64_t first,
                  std::uint64_t count, See&& see) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Plan plan = simulation.plan_of(seed);
    const Outcome outcome = simulation.try_out(plan, false);
    ASSERT_FALSE(outcome.finding) << fmt::format(
        "{}{}: {}; again: ./run fuzz {} --replay {}", simulation.letter, outcome.finding->invariant,
        outcome.finding->sentence, simulation.target, seed);
    see(plan, outcome);
  }
}
template <typename Plan, typename Outcome>
void expect_holds(const SeededSimulation<Plan, Outcome>& simulation, std::uint64_t first,
                  std::uint64_t count) {
  expect_holds(simulation, first, count, [](const Plan&, const Outcome&) {});
}

/// Fails if a second run of a seed differs from the first.
template <typename Plan, typename Outcome>
void expect_same_again(const SeededSimulation<Plan, Outcome>& simulation, std::uint64_t seed) {
  const Plan plan = simulation.plan_of(seed);
  const Outcome one = simulation.try_out(plan, false), again = simulation.try_out(plan, false);
  EXPECT_EQ(one.hash, again.hash) << "seed " << seed;
  EXPECT_EQ(one.received, again.received) << "seed " << seed;
}

}  // namespace reckon::fuzz
