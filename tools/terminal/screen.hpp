// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The terminal as a screen of lines, by ncurses: the one file that knows it.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <span>

#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// Takes the terminal from its construction to its destruction, which gives it back as it was, also
/// where an exception leaves; so does a signal that ends the program. One at a time; one thread.
class TerminalScreen {
 public:
  /// Opens it where `out` and stdin are terminals in which lines can be drawn in place (by TERM:
  /// not in "dumb" and what is not known) and the program is not in the background; else null.
  /// `colour`: whether lines may have colours; bold and reverse they have always.
  [[nodiscard]] static std::unique_ptr<TerminalScreen> open(std::FILE* out, bool colour);
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;

  [[nodiscard]] ScreenSize size() const;
  /// The next key pressed, if any; never waits.
  [[nodiscard]] std::optional<KeyPress> key();
  /// Shows these lines from the top; what does not fit is cut.
  void show(std::span<const ScreenLine> lines);

 private:
  struct Terminal;
  explicit TerminalScreen(std::unique_ptr<Terminal> terminal);
  std::unique_ptr<Terminal> terminal_;
};

}  // namespace reckon::tools
