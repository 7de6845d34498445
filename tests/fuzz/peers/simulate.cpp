// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simulation of peers as a program; docs/robustness.md says what is promised.
#include "reckon/tests/fuzz/peers/trial.hpp"
#include "reckon/tests/fuzz/search/seeded_search.hpp"

namespace reckon::fuzz {
namespace {

Plan calmed(Plan plan) {
  plan.line = {};
  return plan;
}

int run(int argc, char** argv) {
  const SeededSimulation<Plan, Outcome> peers{
      "peers", "Runs seeded simulations of peers that start, fail, and are lied to.",
      "I",     8,
      plan_of, try_out,
      calmed};
  return SeededSearch(peers).run(argc, argv);
}

}  // namespace
}  // namespace reckon::fuzz

int main(int argc, char** argv) { return reckon::fuzz::guarded(reckon::fuzz::run, argc, argv); }
