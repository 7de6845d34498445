// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a long run is doing, every few seconds in one line of the terminal.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace reckon::tools {

/// One line on a terminal that is written over; says nothing where the stream is none.
class StatusLine {
 public:
  static constexpr std::chrono::seconds kPeriod{5};

  /// The first line is due a period after `now`, steady.
  StatusLine(std::FILE* file, std::chrono::nanoseconds now);
  /// Whether it is time for the next line, on a terminal or elsewhere; `now` steady.
  [[nodiscard]] bool due(std::chrono::nanoseconds now) const { return now - shown_ >= kPeriod; }
  void show(const std::string& text, std::chrono::nanoseconds now);
  /// Clears the line, so that the next words begin at the margin.
  void clear();

 private:
  std::FILE* file_;
  bool active_;
  bool visible_ = false;
  std::chrono::nanoseconds shown_;
};

}  // namespace reckon::tools
