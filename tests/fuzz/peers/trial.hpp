// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan: one thread, a clock that jumps from event to event, a network in memory.
#pragma once

#include "reckon/tests/fuzz/peers/watch.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz {

/// The hash covers all received datagrams and their effects. The log has the two lives that the
/// finding concerns, or all lives if there is no finding.
using Outcome = SeededOutcome<LivesFinding>;

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log = false);

inline constexpr SeededSimulation<Plan, Outcome> kSimulation{
    .target = "peers",
    .about = "Runs seeded simulations of peers that start, fail, and are lied to.",
    .letter = "I",
    .same_again = 8,
    .plan_of = plan_of,
    .try_out = try_out,
    .calmed = calmed};

}  // namespace reckon::fuzz
