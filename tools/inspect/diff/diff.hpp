// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect diff A B`: what differs between two captures, and by how much.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/inspect/diff/capture_difference.hpp"
#include "reckon/tools/inspect/diff/motion_difference.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {

/// Runs the verb with the words behind `inspect diff`. 0: the same; 1: different; 2: a file that
/// cannot be read, or wrong usage.
int run_inspect_diff(Arguments arguments, const Console& console);

/// What was found, as it is written out.
struct DiffFindings {
  std::string path_a;
  std::string path_b;
  std::string problem_a;  ///< why the capture ended early; else empty
  std::string problem_b;
  const CaptureDifference& difference;
  const MotionDifference& motion;
  std::chrono::nanoseconds step{};  ///< of the motion's instants
  /// Arrivals that are farther apart count as different; nothing: none does.
  std::optional<std::chrono::nanoseconds> tolerance;

  [[nodiscard]] bool is_same() const;
};

/// Appends the findings; lines end in '\n'.
void append_diff(const DiffFindings& findings, Format format, std::string& out);

}  // namespace reckon::tools
