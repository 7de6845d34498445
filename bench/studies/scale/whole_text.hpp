// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers as processes beside the same exercise in simulated time, as tables and JSON Lines.
#pragma once

#include <span>
#include <string>

#include "reckon/bench/studies/scale/text.hpp"

namespace reckon::bench {

/// A run of processes, and of simulated peers in the same exercise.
struct WholeRow {
  WholeRun run, simulated;
};

/// A table for each: simulated, processes, by how much they differ; then what each lost and takes.
[[nodiscard]] std::string whole_text(std::span<const WholeRow> rows);
/// A line for each.
[[nodiscard]] std::string whole_json(std::span<const WholeRow> rows);

}  // namespace reckon::bench
