// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Files that a study writes.
#pragma once

#include <string>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// Before the work, so that nobody waits for a result that cannot be kept. Nothing for an empty
/// path. @throws UsageError with the path and the remedy.
void check_writable(const std::string& path);

/// Replaces what is there and says so on err. Nothing for an empty path. @throws UsageError.
void write_output(const std::string& path, const std::string& text, const Console& console);

}  // namespace reckon::tools
