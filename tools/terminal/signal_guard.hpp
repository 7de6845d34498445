// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whatever signal ends the program, the terminal is given back first.
#pragma once

#include <cstdint>

namespace reckon::tools {

/// Whether the program may touch the terminal: one in the background would be stopped.
[[nodiscard]] bool in_foreground(int descriptor);

/// What the first Ctrl-C or SIGTERM does that the program itself has a handler for.
enum class FirstRequest : std::uint8_t {
  gives_back,  ///< gives the terminal back, then goes to the handler
  leaves_it,   ///< goes to the handler alone, which ends the program in good order
};

/// While it lives, a signal that ends the program (Ctrl-C and SIGTERM, a second time at the latest;
/// SIGQUIT, SIGHUP; a crash) gives the terminal back and then does what it would have done. One at
/// a time.
class SignalGuard {
 public:
  /// @param give_back may be called in a signal handler, and more than once.
  /// @param takes_stop whether Ctrl-Z gives it back too
  SignalGuard(void (*give_back)(), FirstRequest first, bool takes_stop);
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

  /// Whether a signal has asked for the end.
  [[nodiscard]] static bool has_ended() noexcept;
  /// Calls `act` while none of its signals can come between.
  static void undisturbed(void (*act)());
};

}  // namespace reckon::tools
