// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Results of a sweep of couplings as table, CSV rows, JSON and page.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/bench/studies/stability/study.hpp"

namespace reckon::bench {

/// A complete sweep.
struct StabilityReport {
  std::string command;  ///< as typed
  StabilityPlan plan;
  std::vector<StabilityResult> results;  ///< by run
  std::vector<std::string> notes;        ///< settings of the scene that the study ignores
};

/// Shares of the cells of one mode.
struct StabilitySummary {
  std::string mode;
  std::size_t cells = 0;
  double made_energy = 0;  ///< share, including runs that diverged
  double diverged = 0;
  double peak = 0;               ///< share above StabilityPlan::peak
  std::optional<double> cycles;  ///< share of those that should rest; no value if none should
  std::optional<double> wrong;   ///< share of runs that did not diverge and had a true force
  double right = 0;              ///< share of StabilityVerdict::right
  double least_energy = 0;       ///< [J], least of the runs that did not diverge
  std::optional<double> kept;    ///< median share of the stiffness, over runs that did not diverge
};
[[nodiscard]] std::vector<StabilitySummary> summaries_of(const StabilityReport& report);

/// The table, and the meaning of its columns.
[[nodiscard]] std::string stability_text(const StabilityReport& report);

/// Names of the columns: run, mode, one for each axis, the members of StabilityResult.
[[nodiscard]] std::string stability_columns(const StabilityPlan& plan);
/// One line of the CSV, with all digits.
[[nodiscard]] std::string stability_row(const StabilityPlan& plan, std::size_t run,
                                        const StabilityResult& result);
/// Parses a line; no value if it does not belong to this plan.
[[nodiscard]] std::optional<std::pair<std::size_t, StabilityResult>> read_stability_row(
    const StabilityPlan& plan, std::string_view line);

/// The table of a page.
[[nodiscard]] std::string stability_page_table(const StabilityReport& report);
/// One HTML page with a map of each mode; a tooltip shows all numbers of a cell. Without scripts,
/// and in print, a map shows the verdicts, each with a colour and a letter. With scripts the reader
/// selects the number that is shown.
[[nodiscard]] std::string stability_page(const StabilityReport& report);

/// A line for each run, then a line for each mode.
[[nodiscard]] std::string stability_json(const StabilityReport& report);

/// A sentence for the text of a sweep if the gate is off; empty if it is on.
[[nodiscard]] std::string_view gate_warning(const StabilityPlan& plan);

}  // namespace reckon::bench
