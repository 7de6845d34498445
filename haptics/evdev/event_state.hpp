// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tracks axes and buttons of a device from its events. Pure.
#pragma once

#include <linux/input.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace reckon::haptics {

/// Events take effect frame by frame: those before a SYN_REPORT share one instant. After
/// SYN_DROPPED all events are ignored until set().
class EventState {
 public:
  static constexpr std::size_t kAxes = 2;          ///< ABS_X, ABS_Y
  static constexpr std::size_t kMostButtons = 32;  ///< further ones are ignored

  /// @param codes key codes of the buttons, by button number
  explicit EventState(std::vector<std::uint16_t> codes = {}) : codes_(std::move(codes)) {
    if (codes_.size() > kMostButtons) codes_.resize(kMostButtons);
  }

  /// Sets the whole state, as queried from the kernel. @param axes readings
  void set(const std::array<std::int32_t, kAxes>& axes, std::uint32_t buttons) noexcept {
    now_ = coming_ = {axes, buttons};
    dropped_ = wants_all_ = false;
  }
  void take(const input_event& event) noexcept {
    if (event.type == EV_SYN && event.code == SYN_DROPPED) dropped_ = true;
    if (event.type == EV_SYN && event.code == SYN_REPORT) {
      if (dropped_) {
        wants_all_ = true;
      } else {
        now_ = coming_;
      }
    }
    if (dropped_) return;
    if (event.type == EV_ABS && event.code <= ABS_Y) coming_.axes[event.code] = event.value;
    if (event.type == EV_KEY) take_button(event.code, event.value != 0);
  }
  /// Whether events were dropped and their frame has ended: set() is due.
  [[nodiscard]] bool wants_all() const noexcept { return wants_all_; }

  [[nodiscard]] std::int32_t axis(std::size_t number) const noexcept { return now_.axes[number]; }
  /// Bit i: button i is down.
  [[nodiscard]] std::uint32_t buttons() const noexcept { return now_.buttons; }
  [[nodiscard]] const std::vector<std::uint16_t>& codes() const noexcept { return codes_; }

 private:
  struct Frame {
    std::array<std::int32_t, kAxes> axes{};
    std::uint32_t buttons = 0;
  };

  void take_button(std::uint16_t code, bool is_down) noexcept {
    const auto found = std::ranges::find(codes_, code);
    if (found == codes_.end()) return;
    const std::uint32_t bit = 1U << (found - codes_.begin());
    coming_.buttons = is_down ? coming_.buttons | bit : coming_.buttons & ~bit;
  }

  std::vector<std::uint16_t> codes_;
  Frame now_, coming_;
  bool dropped_ = false, wants_all_ = false;
};

}  // namespace reckon::haptics
