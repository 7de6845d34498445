// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simulation of owners as a program; docs/robustness.md lists its invariants.
#include "reckon/tests/fuzz/owners/trial.hpp"
#include "reckon/tests/fuzz/search/seeded_search.hpp"

int main(int argc, char** argv) {
  return reckon::fuzz::search_seeds(reckon::fuzz::owners::kSimulation, argc, argv);
}
