// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Progress of a long run: one line of the terminal, updated every few seconds.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace reckon::tools {

/// One line on a terminal that is overwritten; writes nothing if the stream is not a terminal.
class StatusLine {
 public:
  static constexpr std::chrono::seconds kPeriod{5};

  /// The first line is due a period after `now`, on the steady clock.
  StatusLine(std::FILE* file, std::chrono::nanoseconds now)
      : file_(file), active_(isatty(fileno(file)) == 1), shown_(now) {}
  /// Whether the next line is due, on a terminal or elsewhere; `now` on the steady clock.
  [[nodiscard]] bool due(std::chrono::nanoseconds now) const { return now - shown_ >= kPeriod; }
  void show(const std::string& text, std::chrono::nanoseconds now) {
    shown_ = now;
    if (!active_) return;
    visible_ = true;
    fmt::print(file_, "\r\033[K{}", text);
    std::fflush(file_);
  }
  /// Clears the line, so that the next text begins at the margin.
  void clear() {
    if (!visible_) return;
    visible_ = false;
    fmt::print(file_, "\r\033[K");
  }

 private:
  std::FILE* file_;
  bool active_;
  bool visible_ = false;
  std::chrono::nanoseconds shown_;
};

}  // namespace reckon::tools
