// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Progress of a long study, and the time that remains.
#pragma once

#include <chrono>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/status_line.hpp"

namespace reckon::bench {

/// A bar with the remaining time on err; no output if err is not a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(const tools::Console& console);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param share of the work that is done, 0 to 1 @param text after the bar
  void show(double share, std::string_view text);

 private:
  tools::StatusLine line_;
  std::chrono::nanoseconds begin_, shown_{0};
};

}  // namespace reckon::bench
