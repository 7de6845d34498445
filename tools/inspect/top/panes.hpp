// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the screen of `top` shows beside its table: one entity in detail, how datagrams are filled,
// and the rules that were broken.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/tools/inspect/top/columns.hpp"
#include "reckon/tools/inspect/top/report.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// Everything that is known of one entity, and a plot of its last jumps.
[[nodiscard]] std::vector<ScreenLine> entity_pane(const TopCell& cell, std::size_t columns);
/// How many PDUs datagrams held.
[[nodiscard]] std::vector<ScreenLine> bundles_pane(const TopData& data);
/// How often each rule was broken, with its remedy.
[[nodiscard]] std::vector<ScreenLine> faults_pane(const TopData& data);

/// Bars of `values`, oldest first, `rows` lines high: '#' for each full step of the largest, '.'
/// for what is above zero and below the first step.
[[nodiscard]] std::vector<std::string> bar_plot(std::span<const double> values, std::size_t rows);

}  // namespace reckon::tools
