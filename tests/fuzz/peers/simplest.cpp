// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Leaves out of a plan what a finding does not need.
#include <cstddef>

#include "reckon/tests/fuzz/peers/trial.hpp"

namespace reckon::fuzz {

Plan simplest(const Plan& plan, int invariant) {
  const auto fails = [invariant](const Plan& fewer) {
    const Outcome outcome = try_out(fewer);
    return outcome.finding && outcome.finding->invariant == invariant;
  };
  Plan least = plan;
  for (std::size_t i = least.faults.size(); i-- > 0;) {
    Plan fewer = least;
    fewer.faults.erase(fewer.faults.begin() + static_cast<std::ptrdiff_t>(i));
    if (fails(fewer)) least = fewer;
  }
  Plan calmer = least;
  calmer.line = {};
  if (fails(calmer)) least = calmer;
  return least;
}

}  // namespace reckon::fuzz
