// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Further panes of `top` next to its table: one entity in detail, the fill of datagrams, and
// violated rules.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/tools/inspect/top/columns.hpp"
#include "reckon/tools/inspect/top/report.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// All data of one entity, and a plot of its last jumps.
[[nodiscard]] std::vector<ScreenLine> entity_pane(const TopCell& cell, std::size_t columns);
/// Distribution of PDUs per datagram.
[[nodiscard]] std::vector<ScreenLine> bundles_pane(const TopData& data);
/// Number of violations of each rule, with its remedy.
[[nodiscard]] std::vector<ScreenLine> faults_pane(const TopData& data);

/// Bars of `values`, oldest first, `rows` lines high: '#' for each full step of the largest, '.'
/// for a value between zero and the first step.
[[nodiscard]] std::vector<std::string> bar_plot(std::span<const double> values, std::size_t rows);

}  // namespace reckon::tools
