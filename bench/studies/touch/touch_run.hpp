// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon bench accuracy --touch`: runs the axes that were asked for and prints them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// The words as typed.
struct TouchOptions {
  std::vector<std::string> axes;  ///< several in one word with commas between; none: all
  std::uint64_t seed = 1;
  bool json = false;
  std::string csv, report, plot;  ///< files to write
};

/// Returns the exit status. @throws UsageError for an axis that is not there and for files that
/// cannot be written.
int bench_touch(const TouchOptions& options, const std::string& command,
                const tools::Console& console);

}  // namespace reckon::bench
