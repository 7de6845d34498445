// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a plan: one thread, kernel calls answered by a model of the device, a servo, a hand that
// presses into a wall, and the model's clock.
#pragma once

#include <cstdint>

#include "reckon/tests/fuzz/search/seeded_simulation.hpp"
#include "reckon/tests/fuzz/unplugs/plan.hpp"

namespace reckon::fuzz::unplugs {

/// The hash covers notices and positions of the handle; `received` counts unplugs.
struct Outcome : SeededOutcome<> {
  std::uint64_t pressed = 0;  ///< unplugs while the motors had a force
};

[[nodiscard]] Outcome try_out(const Plan& plan, bool keep_log = false);

inline constexpr SeededSimulation<Plan, Outcome> kSimulation{
    .target = "unplugs",
    .about = "Unplugs devices at random instants, and breaks their lines otherwise.",
    .letter = "U",
    .same_again = 9,
    .plan_of = plan_of,
    .try_out = try_out,
    .calmed = calmed,
    .counted = "times unplugged"};

}  // namespace reckon::fuzz::unplugs
