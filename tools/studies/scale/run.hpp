// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `bench scale`.
#pragma once

#include <string>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/studies/scale/options.hpp"

namespace reckon::tools {

/// Runs the study and returns the exit status. @throws UsageError @param command as typed
[[nodiscard]] int bench_scale(const ScaleWords& words, const std::string& command,
                              const Console& console);

}  // namespace reckon::tools
