// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan. `./run fuzz owners`.
#pragma once

#include "reckon/tests/fuzz/owners/plan.hpp"
#include "reckon/tests/fuzz/owners/watch.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz::owners {

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log);

inline constexpr SeededSimulation<Plan, Outcome> kSimulation{
    "owners", "Simulates peers that hand objects over, fail, and lose their network.",
    "I",      9,
    plan_of,  try_out,
    calmed,   "messages received"};

}  // namespace reckon::fuzz::owners
