// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The objectives that the touch adversary maximises in turn, and its permitted choices.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/touch/trial.hpp"

namespace reckon::fuzz {

/// One quantity to maximise.
struct Objective {
  std::string name;
  double seconds;                                 // of simulated time
  std::function<double(const Outcome&)> badness;  // higher is worse
  std::function<std::string(const Outcome&)> text;
  void (*rules)(Scenario&);  // restricts the permitted choices
  double most = 1e300;       // maximum badness; more breaks a promise
  Outcome (*run)(const Scenario&, double seconds) = try_out;
};

[[nodiscard]] const std::vector<Objective>& objectives();

/// Runs a scenario as long as the objective takes. Badness above its maximum is also a violation if
/// its rules leave the scenario unchanged; so is a wrong force that no servo reports.
/// @param strict a reported wrong force is a violation, too
[[nodiscard]] Outcome judged(const Objective& objective, const Scenario& scenario, bool strict);

}  // namespace reckon::fuzz
