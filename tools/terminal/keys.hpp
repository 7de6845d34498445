// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads single keys of a terminal, without Enter. The terminal is restored however the program
// ends.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "reckon/tools/terminal/signal_guard.hpp"

namespace reckon::tools {

/// Takes the keys of a terminal while the object exists: no echo, no line mode; Ctrl-C and Ctrl-Z
/// keep their function. One object at a time, on one thread. Does nothing if the descriptor is not
/// a terminal, or while the program is in the background.
class TerminalKeys {
 public:
  explicit TerminalKeys(int descriptor);
  /// Restores the terminal and the signal handlers.
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  [[nodiscard]] bool is_active() const { return active_; }
  /// Waits at most `patience` for keys. @return their number, 0 for none. A signal ends the wait.
  std::size_t read(std::span<char> out, std::chrono::nanoseconds patience);

 private:
  int descriptor_;
  bool active_;
  std::optional<SignalGuard> guard_;
};

}  // namespace reckon::tools
