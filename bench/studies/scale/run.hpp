// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `bench scale`.
#pragma once

#include <string>

#include "reckon/bench/studies/scale/options.hpp"
#include "reckon/bench/studies/scale/page.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// All results of the report, as tables or as JSON Lines; empty if it has none.
/// @param wide tables with all columns
[[nodiscard]] std::string scale_findings(const ScaleReport& report, bool json, bool wide = false);

/// Runs the study. A stopped study reports its completed runs. @param command as typed
/// @return exit status: `findings` if something differs from the base  @throws UsageError
[[nodiscard]] int bench_scale(const ScaleWords& words, const std::string& command,
                              const tools::Console& console);

}  // namespace reckon::bench
