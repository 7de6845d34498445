// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study of accuracy of `reckon bench`: runs what was asked for and prints it.
#pragma once

#include <string>

#include "reckon/bench/studies/accuracy/options.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// `command` as typed, for the report. Returns the exit status; throws UsageError.
[[nodiscard]] int bench_accuracy(const BenchOptions& options, const std::string& command,
                                 const tools::Console& console);

}  // namespace reckon::bench
