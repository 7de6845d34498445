// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/event_state.hpp"

#include <algorithm>
#include <utility>

namespace reckon::haptics {

EventState::EventState(std::vector<std::uint16_t> codes) : codes_(std::move(codes)) {
  if (codes_.size() > kMostButtons) codes_.resize(kMostButtons);
}

void EventState::set(const std::array<std::int32_t, kAxes>& axes, std::uint32_t buttons) noexcept {
  now_ = coming_ = {axes, buttons};
  dropped_ = wants_all_ = false;
}

void EventState::take(const input_event& event) noexcept {
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

void EventState::take_button(std::uint16_t code, bool is_down) noexcept {
  const auto found = std::ranges::find(codes_, code);
  if (found == codes_.end()) return;
  const std::uint32_t bit = 1U << (found - codes_.begin());
  coming_.buttons = is_down ? coming_.buttons | bit : coming_.buttons & ~bit;
}

}  // namespace reckon::haptics
