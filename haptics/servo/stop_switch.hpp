// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What one servo sees of the software stop, and the button of its device that presses it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/force_stop.hpp"

namespace reckon::haptics {

/// The button presses the stop as it goes down, and releases it as it goes down again, where the
/// stop was pressed kLeastHeld ago or longer: two hands that press at once, or a hand that presses
/// twice in haste, want it pressed. It counts as down only after it was up for kSettled: the
/// contacts of a button bounce. One that is down at the first reading presses. Readings that failed
/// say nothing of it. Servo thread.
class StopSwitch {
 public:
  static constexpr std::chrono::milliseconds kSettled{50};
  static constexpr std::chrono::milliseconds kLeastHeld{500};

  /// @param shared with other servos, outlives this; null: a stop of its own, for its button
  /// @param button bit number in DeviceSample::buttons, 0 to 31; none: no button stops
  StopSwitch(ForceStop* shared, std::optional<int> button) noexcept
      : shared_(shared), button_(button) {}

  /// Call once in each step, in which no force may be shown where it returns true: the stop is
  /// pressed, or was pressed and released since the last step.
  [[nodiscard]] bool look(const DeviceSample& sample, std::chrono::nanoseconds now) noexcept;

 private:
  void press_or_release(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] bool goes_down(const DeviceSample& sample, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] ForceStop& stop() noexcept { return shared_ != nullptr ? *shared_ : own_; }

  ForceStop own_;
  ForceStop* shared_;
  std::optional<int> button_;
  std::uint32_t seen_ = 0;                     // changes of the stop
  std::chrono::nanoseconds pressed_since_{0};  // as seen here
  bool settled_ = true;                        // the button was up for long enough
  bool up_ = false;
  std::chrono::nanoseconds up_since_{0};
};

}  // namespace reckon::haptics
