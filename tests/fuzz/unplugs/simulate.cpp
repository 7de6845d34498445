// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The storm of unplugs as a program; docs/robustness.md says what is promised.
#include "reckon/tests/fuzz/search/seeded_search.hpp"
#include "reckon/tests/fuzz/unplugs/trial.hpp"

namespace reckon::fuzz::unplugs {
namespace {

int run(int argc, char** argv) {
  const SeededSimulation<Plan, Outcome> unplugs{
      "unplugs", "Unplugs devices at random instants, and breaks their lines otherwise.",
      "U",       9,
      plan_of,   try_out,
      calmed,    "times unplugged"};
  return SeededSearch(unplugs).run(argc, argv);
}

}  // namespace
}  // namespace reckon::fuzz::unplugs

int main(int argc, char** argv) {
  return reckon::fuzz::guarded(reckon::fuzz::unplugs::run, argc, argv);
}
