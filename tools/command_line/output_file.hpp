// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output files of a study.
#pragma once

#include <string>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// Checks that the file can be written. Call it before a long computation, so that the result is
/// not lost at the end. Does not leave a new file behind. An empty path means no file and passes.
/// @throws UsageError with the path and the remedy.
void check_writable(const std::string& path);

/// Writes the text to the file and replaces an existing file. @throws UsageError.
void save_output(const std::string& path, const std::string& text);

/// The same, and reports the path on console.err. An empty path writes nothing.
void write_output(const std::string& path, const std::string& text, const Console& console);

}  // namespace reckon::tools
