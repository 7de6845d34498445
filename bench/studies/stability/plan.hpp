// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sweep of couplings: its cells in a fixed order, and the run of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/bench/studies/stability/parameters.hpp"

namespace reckon::bench {

/// Greatest number of runs in one sweep, over all modes.
inline constexpr std::size_t kMostRuns = 200'000;

/// Every cell is run in every mode, with the same delays and losses for its samples.
struct StabilityPlan {
  StabilitySetting base;
  std::vector<CouplingMode> modes;  ///< at least one
  std::vector<StabilityAxis> axes;  ///< may be empty: one cell
  std::uint64_t seed = 1;
  bool gate = true;        ///< applies to mode reckon
  double peak = 10;        ///< [N] above which the summary counts; not part of a run
  std::string trace_file;  ///< of StabilitySetting::recorded: as typed, and a hash of its content

  [[nodiscard]] std::size_t cells() const;
  [[nodiscard]] std::size_t runs() const { return cells() * modes.size(); }
  /// Index of the value of axis `axis` in cell `cell`; the last axis varies fastest.
  [[nodiscard]] std::size_t place(std::size_t cell, std::size_t axis) const;
  /// Setting of cell `cell`, with every axis applied; its seed follows from the plan's seed and
  /// `cell`.
  [[nodiscard]] StabilitySetting setting(std::size_t cell) const;
  /// Run number `run`: mode by mode, cell by cell.
  [[nodiscard]] CouplingRun run(std::size_t run) const;
  [[nodiscard]] std::size_t cell_of(std::size_t run) const { return run % cells(); }
  [[nodiscard]] CouplingMode mode_of(std::size_t run) const { return modes[run / cells()]; }
  /// For example "reckon" or "reckon_no_gate".
  [[nodiscard]] std::string mode_name(CouplingMode mode) const;
  /// All inputs that affect an outcome, as "name=value" separated by "; ".
  [[nodiscard]] std::string text() const;
};

/// Stiffness 250 to 1800 N/m x delay 0 to 200 ms x loss 0, 30 % x jitter 0, 30 % x every
/// environment: 320 cells, one hand that pushes.
[[nodiscard]] std::vector<StabilityAxis> default_axes();

/// @throws UsageError if an axis has no effect, two axes are equivalent, or a cell is impossible
void check(const StabilityPlan& plan);

}  // namespace reckon::bench
