// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The study `bench stability`.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// The words as typed.
struct StabilityWords {
  std::string scene;                ///< file; empty: a study without one
  std::vector<std::string> sweeps;  ///< "delay=0..200ms/5"
  std::vector<std::string> modes;   ///< names between commas; none: the scene's baseline, else all
  std::string hand;                 ///< recorded trace of the hand
  std::string peak = "10 N";
  std::string csv, report;
  std::optional<std::uint64_t> seed;
  std::optional<std::chrono::nanoseconds> length;  ///< of each run; 12 s
  bool no_gate = false, json = false;
};

/// Runs the study and returns the exit status. @throws UsageError @param command as typed
[[nodiscard]] int bench_stability(const StabilityWords& words, const std::string& command,
                                  const tools::Console& console);

}  // namespace reckon::bench
