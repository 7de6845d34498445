// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sweep of couplings as table, CSV rows, JSON and page.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/bench/studies/stability/study.hpp"

namespace reckon::bench {

/// A sweep that was run whole.
struct StabilityReport {
  std::string command;  ///< as typed
  StabilityPlan plan;
  std::vector<StabilityResult> results;  ///< by run
  std::vector<std::string> notes;        ///< what of a scene the study leaves out
};

/// Shares of the cells of one mode.
struct StabilitySummary {
  std::string mode;
  std::size_t cells = 0;
  double made_energy = 0;  ///< share, those that ran away among them
  double diverged = 0;
  double peak = 0;               ///< of those above StabilityPlan::peak
  std::optional<double> cycles;  ///< of those that should come to rest; nothing where none should
  std::optional<double> wrong;   ///< of those that did not run away and felt something
  double right = 0;              ///< share of StabilityVerdict::right
  double least_energy = 0;       ///< [J], the worst that did not run away
  std::optional<double> kept;    ///< median share of the stiffness, of those that did not run away
};
[[nodiscard]] std::vector<StabilitySummary> summaries_of(const StabilityReport& report);

/// The table, and what its columns mean.
[[nodiscard]] std::string stability_text(const StabilityReport& report);

/// Names of the columns: run, mode, an axis each, the members of StabilityResult.
[[nodiscard]] std::string stability_columns(const StabilityPlan& plan);
/// One line of the CSV, all digits.
[[nodiscard]] std::string stability_row(const StabilityPlan& plan, std::size_t run,
                                        const StabilityResult& result);
/// Back from a line; nothing where it is none of this plan.
[[nodiscard]] std::optional<std::pair<std::size_t, StabilityResult>> read_stability_row(
    const StabilityPlan& plan, std::string_view line);

/// The table of a page.
[[nodiscard]] std::string stability_page_table(const StabilityReport& report);
/// One HTML page with a map of each mode; a tooltip shows all numbers of a cell. Without scripts,
/// and in print, a map shows the verdicts, each with a colour and a letter. With scripts a reader
/// selects the number that it shows.
[[nodiscard]] std::string stability_page(const StabilityReport& report);

/// A line for each run, then one for each mode.
[[nodiscard]] std::string stability_json(const StabilityReport& report);

/// What `text` of a sweep says in a sentence where the gate is off; empty where it is on.
[[nodiscard]] std::string_view gate_warning(const StabilityPlan& plan);

}  // namespace reckon::bench
