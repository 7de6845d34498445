// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Faults that hit a hand-over or a decision in progress. Independent faults rarely do.
#pragma once

#include "reckon/tests/fuzz/owners/plan.hpp"
#include "reckon/tests/fuzz/search/dice.hpp"

namespace reckon::fuzz::owners {

/// Replaces the faults by an episode in three of five plans that have any.
void add_episode(Plan& plan, Dice& dice);

}  // namespace reckon::fuzz::owners
