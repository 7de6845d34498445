// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/stop_switch.hpp"

namespace reckon::haptics {

bool StopSwitch::look(const DeviceSample& sample, std::chrono::nanoseconds now) noexcept {
  if (goes_down(sample, now)) press_or_release(now);
  const std::uint32_t changes = stop().changes();
  const bool is_new = changes != seen_;
  if (is_new) pressed_since_ = now;
  seen_ = changes;
  return (changes & 1U) != 0 || is_new;
}

void StopSwitch::press_or_release(std::chrono::nanoseconds now) noexcept {
  const bool is_held = stop().is_pressed();
  if (!is_held) {
    stop().press(StopCause::button);
  } else if (stop().changes() == seen_ && now - pressed_since_ >= kLeastHeld) {
    stop().release(StopCause::button);
  }
}

bool StopSwitch::goes_down(const DeviceSample& sample, std::chrono::nanoseconds now) noexcept {
  if (!button_ || !sample.ok) return false;
  if ((sample.buttons >> *button_ & 1U) == 0) {
    if (!up_) up_since_ = now;
    up_ = true;
    settled_ = settled_ || now - up_since_ >= kSettled;
    return false;
  }
  up_ = false;
  const bool counts = settled_;
  settled_ = false;
  return counts;
}

}  // namespace reckon::haptics
