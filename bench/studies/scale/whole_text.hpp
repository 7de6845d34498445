// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers beside the model of the same exercise, as tables and JSON Lines.
#pragma once

#include <span>
#include <string>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// A run of whole peers, and what the light ones of all mechanisms did in the same exercise.
struct WholeRow {
  WholeRun run;
  ScaleRow model;
};

/// A table for each: model, whole peers, by how much they differ; then what each lost and takes.
[[nodiscard]] std::string whole_text(std::span<const WholeRow> rows);
/// A line for each.
[[nodiscard]] std::string whole_json(std::span<const WholeRow> rows);

}  // namespace reckon::bench
