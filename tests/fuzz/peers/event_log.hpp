// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Event log of a simulation run.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/peers/watch.hpp"

namespace reckon::fuzz {

class EventLog {
 public:
  /// @param life the life concerned; kNobody: all
  void add(std::size_t life, std::string text) { lines_.push_back({life, std::move(text)}); }

  /// The last lines; with a finding, those of the two lives it concerns.
  [[nodiscard]] std::vector<std::string> lines(const std::optional<LivesFinding>& finding) const {
    std::vector<std::string> lines;
    for (const Line& line : lines_) {
      const bool concerned = !finding || line.life == kNobody || line.life == finding->life ||
                             line.life == finding->other;
      if (concerned) lines.push_back(line.text);
    }
    if (lines.size() > std::size_t{kMost}) lines.erase(lines.begin(), lines.end() - kMost);
    return lines;
  }

 private:
  static constexpr std::ptrdiff_t kMost = 400;
  struct Line {
    std::size_t life;
    std::string text;
  };
  std::vector<Line> lines_;
};

}  // namespace reckon::fuzz
