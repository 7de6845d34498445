// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Control of the software stop by the user of a demo or a peer, and its notices.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/exchange/force_stop.hpp"

namespace reckon::tools {

/// The software stop of a program: pressed and released by SIGUSR1, by a key, and by the buttons of
/// devices. Construct it before any thread and any device; one at a time. One thread, except for
/// stop().
///
///     StopControl stop;
///     options.force_stop = &stop.stop();
///     if (display.take_stop_key()) stop.press_key(clock.now());
///     display.add(stop.take_notices());
class StopControl {
 public:
  /// From now on SIGUSR1 presses and releases the stop.
  StopControl();
  /// Restores the earlier action of SIGUSR1, except the default action, which would end the
  /// program.
  ~StopControl();
  StopControl(const StopControl&) = delete;
  StopControl& operator=(const StopControl&) = delete;

  /// A second press within this time does not release the stop: hasty presses mean a stop.
  static constexpr std::chrono::milliseconds kLeastHeld{500};

  [[nodiscard]] haptics::ForceStop& stop() noexcept { return stop_; }
  /// @param now steady time
  void press_key(std::chrono::nanoseconds now) noexcept;
  /// A sentence if it was pressed or released since the last call.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  haptics::ForceStop stop_;
  std::chrono::nanoseconds pressed_at_{0};  // press by the key
  std::uint32_t told_ = 0;                  // reported changes
  struct sigaction before_ {};
};

}  // namespace reckon::tools
