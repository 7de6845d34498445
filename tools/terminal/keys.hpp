// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keys of a terminal one by one, without Enter; whatever ends the program, the terminal is given
// back as it was.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

#include "reckon/tools/terminal/signal_guard.hpp"

namespace reckon::tools {

/// Takes the keys of a terminal while it lives: no echo, no lines; Ctrl-C and Ctrl-Z stay what they
/// are. One at a time, on one thread. Does nothing where the descriptor is no terminal, and leaves
/// it alone while the program is in the background.
class TerminalKeys {
 public:
  explicit TerminalKeys(int descriptor);
  /// Gives the terminal and the signal handlers back.
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  [[nodiscard]] bool is_active() const { return active_; }
  /// Waits for keys, `patience` at most, and gives what is there; 0 is nothing. A signal ends the
  /// wait.
  std::size_t read(std::span<char> out, std::chrono::nanoseconds patience);

 private:
  int descriptor_;
  bool active_;
  std::optional<SignalGuard> guard_;
};

}  // namespace reckon::tools
