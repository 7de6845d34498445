// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Restores the terminal before any signal ends the program.
#pragma once

#include <cstdint>

namespace reckon::tools {

/// Whether the program may use the terminal: a background program would be stopped.
[[nodiscard]] bool in_foreground(int descriptor);

/// Effect of the first Ctrl-C or SIGTERM for which the program has its own handler.
enum class FirstRequest : std::uint8_t {
  gives_back,  ///< restores the terminal, then calls the handler
  leaves_it,   ///< only calls the handler, which ends the program in an orderly way
};

/// While the object exists, a signal that ends the program restores the terminal and then has its
/// normal effect: Ctrl-C and SIGTERM (the second time at the latest), SIGQUIT, SIGHUP, a crash. One
/// object at a time.
class SignalGuard {
 public:
  /// @param give_back may be called in a signal handler, and more than once
  /// @param takes_stop whether Ctrl-Z calls it too
  SignalGuard(void (*give_back)(), FirstRequest first, bool takes_stop);
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

  /// Whether a signal has requested the end.
  [[nodiscard]] static bool has_ended() noexcept;
  /// Calls `act` with the signals blocked.
  static void undisturbed(void (*act)());
};

}  // namespace reckon::tools
