// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simulation of leaders as a program; docs/robustness.md says what is promised.
#include "reckon/tests/fuzz/leaders/trial.hpp"
#include "reckon/tests/fuzz/search/seeded_search.hpp"

namespace reckon::fuzz::leaders {
namespace {

Plan calmed(Plan plan) {
  plan.line = {0.0, 0.0, 0.0, plan.line.delay};
  return plan;
}

int run(int argc, char** argv) {
  const SeededSimulation<Plan, Outcome> leaders{
      "leaders", "Runs seeded simulations of leaders that are elected, cut off and killed.",
      "L",       9,
      plan_of,   try_out,
      calmed};
  return SeededSearch(leaders).run(argc, argv);
}

}  // namespace
}  // namespace reckon::fuzz::leaders

int main(int argc, char** argv) {
  return reckon::fuzz::guarded(reckon::fuzz::leaders::run, argc, argv);
}
