// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the adversary of touch makes worse, one after the other, and what it may choose for that.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {

/// One thing to make worse.
struct Objective {
  std::string name;
  double seconds;                                 // of simulated time
  std::function<double(const Outcome&)> badness;  // higher is worse
  std::function<std::string(const Outcome&)> text;
  void (*rules)(Scenario&);  // what it is not allowed to choose
  double most = 1e300;       // of badness; more breaks a promise
  Outcome (*run)(const Scenario&, double seconds) = try_out;
};

[[nodiscard]] const std::vector<Objective>& objectives();

/// Runs it as long as the objective takes. More badness than that allows is a violation too, where
/// its rules let the scenario as it is; so is a wrong force that no servo tells.
/// @param strict one that is told too
[[nodiscard]] Outcome judged(const Objective& objective, const Scenario& scenario, bool strict);

}  // namespace reckon::fuzz
