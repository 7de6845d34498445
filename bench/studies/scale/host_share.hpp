// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The peers of one host in an exercise on several hosts. hosts.hpp starts them over ssh and sends
// words to them.
#pragma once

#include <cstddef>
#include <string>

#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// The peers of this host.
struct HostShare {
  std::size_t first = 0, end = 0;  ///< numbers from 0
  std::string interface;           ///< empty: chosen by rule
};
/// "FIRST-LAST", numbers from 1, or "FIRST-LAST=INTERFACE". @throws UsageError with the remedy
[[nodiscard]] HostShare read_host_share(const std::string& text);

/// Runs the peers as processes after the word to begin on stdin, and prints a line for each. Ends
/// when stdin ends. @throws EnvironmentError if the interface is unusable, UsageError for a share
/// beyond the peers of the exercise, or for an unknown word
void run_host_share(const ScaleSetting& setting, const HostShare& share,
                    const tools::Console& console);

}  // namespace reckon::bench
