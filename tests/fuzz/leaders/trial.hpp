// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan: one thread, a clock that jumps from event to event, an in-memory network, and a
// watch that checks the invariants every 50 ms.
#pragma once

#include "reckon/tests/fuzz/leaders/plan.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz::leaders {

/// The hash covers all received datagrams.
using Outcome = SeededOutcome<>;

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log = false);

inline constexpr SeededSimulation<Plan, Outcome> kSimulation{
    .target = "leaders",
    .about = "Runs seeded simulations of leaders that are elected, cut off and killed.",
    .letter = "L",
    .same_again = 9,
    .plan_of = plan_of,
    .try_out = try_out,
    .calmed = calmed};

}  // namespace reckon::fuzz::leaders
