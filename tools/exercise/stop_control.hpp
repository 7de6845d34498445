// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How the user of a demo or a peer presses the software stop, and what is told of it.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/exchange/force_stop.hpp"

namespace reckon::tools {

/// The software stop of a program: pressed and released by SIGUSR1, by a key, and by the buttons of
/// devices. Made before any thread and any device; one at a time. One thread, but for stop().
///
///     StopControl stop;
///     options.force_stop = &stop.stop();
///     if (display.take_stop_key()) stop.press_key(clock.now());
///     display.add(stop.take_notices());
class StopControl {
 public:
  /// From now on SIGUSR1 presses and releases it.
  StopControl();
  /// SIGUSR1 does again what it did before, but ends no program that is about to end.
  ~StopControl();
  StopControl(const StopControl&) = delete;
  StopControl& operator=(const StopControl&) = delete;

  /// A key that is pressed again sooner than this does not release: who presses in haste wants no
  /// force.
  static constexpr std::chrono::milliseconds kLeastHeld{500};

  [[nodiscard]] haptics::ForceStop& stop() noexcept { return stop_; }
  /// @param now steady
  void press_key(std::chrono::nanoseconds now) noexcept;
  /// A sentence where it was pressed or released since the last call.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  haptics::ForceStop stop_;
  std::chrono::nanoseconds pressed_at_{0};  // by the key
  std::uint32_t told_ = 0;                  // changes
  struct sigaction before_ {};
};

}  // namespace reckon::tools
