// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the axes and buttons of a device are, by the events it sends. Pure.
#pragma once

#include <linux/input.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::haptics {

/// Events are believed frame by frame: what comes between two reports of the kernel is one instant.
/// Where the kernel dropped some, what follows is not believed until the state is set anew.
class EventState {
 public:
  static constexpr std::size_t kAxes = 2;          ///< ABS_X, ABS_Y
  static constexpr std::size_t kMostButtons = 32;  ///< further ones are not seen

  /// @param codes of the buttons, in the order of their numbers
  explicit EventState(std::vector<std::uint16_t> codes = {});

  /// Sets all of it, as asked of the kernel. @param axes readings
  void set(const std::array<std::int32_t, kAxes>& axes, std::uint32_t buttons) noexcept;
  void take(const input_event& event) noexcept;
  /// Whether events were dropped, and the frame in which they were has ended: set() is due.
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
