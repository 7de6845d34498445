// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The unplug simulation as a program; docs/robustness.md lists its invariants.
#include "reckon/tests/fuzz/search/seeded_search.hpp"
#include "reckon/tests/fuzz/unplugs/trial.hpp"

int main(int argc, char** argv) {
  return reckon::fuzz::search_seeds(reckon::fuzz::unplugs::kSimulation, argc, argv);
}
