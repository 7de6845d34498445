// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compares peers as processes with the same exercise in simulated time, as tables and JSON Lines.
#pragma once

#include <span>
#include <string>

#include "reckon/bench/studies/scale/live_costs.hpp"
#include "reckon/bench/studies/scale/text.hpp"

namespace reckon::bench {

/// A run of processes, and the same exercise with simulated peers.
struct WholeRow {
  WholeRun run, simulated;
  double load = 0;  ///< of the machine during the run: threads that run or wait
  std::vector<CostSample> samples = {};  ///< measured before and after the run
};

/// A table for each row: simulated, processes, difference; then losses and costs of each peer.
[[nodiscard]] std::string whole_text(std::span<const WholeRow> rows);
/// A line for each.
[[nodiscard]] std::string whole_json(std::span<const WholeRow> rows);

}  // namespace reckon::bench
