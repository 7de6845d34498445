// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The peers of one host of an exercise on several: started there over ssh by hosts.hpp, whose words
// it reads.
#pragma once

#include <cstddef>
#include <string>

#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// Which peers live here.
struct HostShare {
  std::size_t first = 0, end = 0;  ///< numbers
  std::string interface;           ///< empty: chosen by rule
};
/// "FIRST-LAST", numbers from 1, or "FIRST-LAST=INTERFACE". @throws UsageError with the remedy
[[nodiscard]] HostShare read_host_share(const std::string& text);

/// Runs them as processes from the word on stdin to begin, and prints a line for each. Ends where
/// stdin does. @throws EnvironmentError where the interface cannot be used, UsageError for a share
/// that is not of this exercise, or other words
void run_host_share(const ScaleSetting& setting, const HostShare& share,
                    const tools::Console& console);

}  // namespace reckon::bench
