// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tracks axes and buttons of a device from its events. Pure.
#pragma once

#include <linux/input.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::haptics {

/// Events take effect frame by frame: those before a SYN_REPORT share one instant. After
/// SYN_DROPPED all events are ignored until set().
class EventState {
 public:
  static constexpr std::size_t kAxes = 2;          ///< ABS_X, ABS_Y
  static constexpr std::size_t kMostButtons = 32;  ///< further ones are ignored

  /// @param codes key codes of the buttons, by button number
  explicit EventState(std::vector<std::uint16_t> codes = {});

  /// Sets the whole state, as queried from the kernel. @param axes readings
  void set(const std::array<std::int32_t, kAxes>& axes, std::uint32_t buttons) noexcept;
  void take(const input_event& event) noexcept;
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

  void take_button(std::uint16_t code, bool is_down) noexcept;

  std::vector<std::uint16_t> codes_;
  Frame now_, coming_;
  bool dropped_ = false, wants_all_ = false;
};

}  // namespace reckon::haptics
