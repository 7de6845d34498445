// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `bench scale`.
#pragma once

#include <string>

#include "reckon/bench/studies/scale/options.hpp"
#include "reckon/bench/studies/scale/page.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// All that the report has, as tables or as JSON Lines; empty where it has nothing.
/// @param wide tables with all columns
[[nodiscard]] std::string scale_findings(const ScaleReport& report, bool json, bool wide = false);

/// Runs the study and returns the exit status, `findings` where something differs from the base. Of
/// a study that is stopped the runs that had ended are reported. @throws UsageError @param command
/// as typed
[[nodiscard]] int bench_scale(const ScaleWords& words, const std::string& command,
                              const tools::Console& console);

}  // namespace reckon::bench
