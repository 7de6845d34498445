// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One servo's view of the software stop, and the button of its device that presses it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/force_stop.hpp"

namespace reckon::haptics {

/// The button presses the stop when it goes down. The next time, it releases the stop if that was
/// pressed at least kLeastHeld ago: two hands that press at once, or one that presses twice in
/// haste, mean to stop. A press counts only after the button was up for kSettled (contact bounce).
/// A button that is down at the first reading presses. Failed readings are ignored. Servo thread.
class StopSwitch {
 public:
  static constexpr std::chrono::milliseconds kSettled{50};
  static constexpr std::chrono::milliseconds kLeastHeld{500};

  /// @param shared with other servos, outlives this; null: a private stop for its button
  /// @param button bit number in DeviceSample::buttons, 0 to 31; none: no button stops
  StopSwitch(ForceStop* shared, std::optional<int> button) noexcept
      : shared_(shared), button_(button) {}

  /// Call once in each step. If true, the step must not render a force: the stop is pressed, or was
  /// pressed and released since the last step.
  [[nodiscard]] bool look(const DeviceSample& sample, std::chrono::nanoseconds now) noexcept {
    if (goes_down(sample, now)) press_or_release(now);
    const std::uint32_t changes = stop().changes();
    const bool is_new = changes != seen_;
    if (is_new) pressed_since_ = now;
    seen_ = changes;
    return (changes & 1U) != 0 || is_new;
  }

 private:
  void press_or_release(std::chrono::nanoseconds now) noexcept {
    const bool is_held = stop().is_pressed();
    if (!is_held) {
      stop().press(StopCause::button);
    } else if (stop().changes() == seen_ && now - pressed_since_ >= kLeastHeld) {
      stop().release(StopCause::button);
    }
  }
  [[nodiscard]] bool goes_down(const DeviceSample& sample, std::chrono::nanoseconds now) noexcept {
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
  [[nodiscard]] ForceStop& stop() noexcept { return shared_ != nullptr ? *shared_ : own_; }

  ForceStop own_;
  ForceStop* shared_;
  std::optional<int> button_;
  std::uint32_t seen_ = 0;                     // number of changes of the stop at the last call
  std::chrono::nanoseconds pressed_since_{0};  // when a call last saw a change of the stop
  bool settled_ = true;                        // the button was up for kSettled
  bool up_ = false;
  std::chrono::nanoseconds up_since_{0};
};

}  // namespace reckon::haptics
