// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect diff A B`: kinds and sizes of the differences of two captures.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/inspect/diff/capture_difference.hpp"
#include "reckon/tools/inspect/diff/motion_difference.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {

/// Runs the verb with the words after `inspect diff`. 0: the same; 1: different; 2: a file that
/// cannot be read, or wrong usage.
int run_inspect_diff(Arguments arguments, const Console& console);

/// Findings of a run, for output.
struct DiffFindings {
  std::string path_a;
  std::string path_b;
  std::string problem_a;  ///< reason if the capture ended early; else empty
  std::string problem_b;
  const CaptureDifference& difference;
  const MotionDifference& motion;
  std::chrono::nanoseconds step{};  ///< interval of the motion comparison
  /// Differences of arrivals above this count as different; no value: arrivals are not compared.
  std::optional<std::chrono::nanoseconds> tolerance;

  [[nodiscard]] bool is_same() const;
};

/// Appends the findings; lines end in '\n'.
void append_diff(const DiffFindings& findings, Format format, std::string& out);

}  // namespace reckon::tools
