// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The terminal as a screen of lines: the only file that includes ncurses.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <span>

#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// Takes over the terminal from construction to destruction, which restores it, after an exception
/// too. A signal that ends the program also restores it. One object at a time; one thread.
class TerminalScreen {
 public:
  /// Opens the screen, or returns null. `out` and stdin must be terminals in which lines can be
  /// drawn in place (by TERM: not "dumb" or unknown), and the program must not be in the
  /// background. `colour`: whether lines may have colours; they always have bold and reverse.
  [[nodiscard]] static std::unique_ptr<TerminalScreen> open(std::FILE* out, bool colour);
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;

  [[nodiscard]] ScreenSize size() const;
  /// The next pressed key, if any; never waits.
  [[nodiscard]] std::optional<KeyPress> key();
  /// Shows these lines from the top; excess is cut off.
  void show(std::span<const ScreenLine> lines);

 private:
  struct Terminal;
  explicit TerminalScreen(std::unique_ptr<Terminal> terminal);
  std::unique_ptr<Terminal> terminal_;
};

}  // namespace reckon::tools
