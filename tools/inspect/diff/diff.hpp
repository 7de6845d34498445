// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect diff A B`: differences of two captures and their size.
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

/// Findings of a run, to be written.
struct DiffFindings {
  std::string path_a;
  std::string path_b;
  std::string problem_a;  ///< reason if the capture ended early; else empty
  std::string problem_b;
  const CaptureDifference& difference;
  const MotionDifference& motion;
  std::chrono::nanoseconds step{};  ///< between the times of the motion comparison
  /// Difference of arrivals above which they count as different; no value: none does.
  std::optional<std::chrono::nanoseconds> tolerance;

  [[nodiscard]] bool is_same() const;
};

/// Appends the findings; lines end in '\n'.
void append_diff(const DiffFindings& findings, Format format, std::string& out);

}  // namespace reckon::tools
