// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Progress of a study on a terminal, and its end at Ctrl-C.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/status_line.hpp"

namespace reckon::bench {

class StudyWatch {
 public:
  explicit StudyWatch(const tools::Console& console)
      : console_(console), line_(console.err, now()) {}
  ~StudyWatch() { line_.clear(); }
  StudyWatch(const StudyWatch&) = delete;
  StudyWatch& operator=(const StudyWatch&) = delete;

  /// Progress of one part: "circle: 3 of 20 settings". False ends the study.
  [[nodiscard]] std::function<bool(std::size_t done, std::size_t all)> of(
      std::string_view noun, std::string_view subject = {}) {
    return [this, noun, subject](std::size_t done, std::size_t all) {
      if (line_.due(now()))
        line_.show(
            fmt::format("{}{}{} of {} {}", subject, subject.empty() ? "" : ": ", done, all, noun),
            now());
      return !console_.stopped();
    };
  }

 private:
  static std::chrono::nanoseconds now() {
    return std::chrono::steady_clock::now().time_since_epoch();
  }

  const tools::Console& console_;
  tools::StatusLine line_;
};

}  // namespace reckon::bench
