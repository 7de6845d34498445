// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/status_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace reckon::tools {

StatusLine::StatusLine(std::FILE* file, std::chrono::nanoseconds now)
    : file_(file), active_(isatty(fileno(file)) == 1), shown_(now) {}

void StatusLine::show(const std::string& text, std::chrono::nanoseconds now) {
  shown_ = now;
  if (!active_) return;
  visible_ = true;
  fmt::print(file_, "\r\033[K{}", text);
  std::fflush(file_);
}

void StatusLine::clear() {
  if (!visible_) return;
  visible_ = false;
  fmt::print(file_, "\r\033[K");
}

}  // namespace reckon::tools
