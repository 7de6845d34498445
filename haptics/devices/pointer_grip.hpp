// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Strength of the grip of a hand that follows a pointer.
#pragma once

#include <algorithm>

namespace reckon::haptics {

/// Share of the grip's spring and damper, 0 .. 1. It is full until the first sample, after rest(),
/// and while samples hold it. Otherwise it fades, and returns as smoothly. It is zero kPatience +
/// kFade = 0.29 s after the last sample.
class PointerGrip {
 public:
  static constexpr double kPatience =
      0.14;  ///< [s], longest interval between samples of a held pointer
  static constexpr double kFade = 0.15;  ///< [s], from full to zero or back

  /// Takes a sample. @param held whether the pointer is held
  void take(bool held) noexcept {
    rests_ = false;
    held_ = held;
    since_ = 0.0;
  }

  /// Returns to the state before the first sample.
  void rest() noexcept { rests_ = true; }

  /// @param h [s] >= 0
  void advance(double h) noexcept {
    since_ += h;
    phase_ = std::clamp(phase_ + (rests_ || holds() ? h : -h) / kFade, 0.0, 1.0);
  }

  /// Whether the pointer is held and its last sample is at most kPatience old.
  [[nodiscard]] bool holds() const noexcept { return held_ && since_ <= kPatience; }
  /// True before the first sample, and after rest().
  [[nodiscard]] bool rests() const noexcept { return rests_; }
  /// Time since the last sample [s].
  [[nodiscard]] double since() const noexcept { return since_; }
  /// Minimum jerk between 0 and 1.
  [[nodiscard]] double share() const noexcept {
    return phase_ * phase_ * phase_ * (10.0 + phase_ * (6.0 * phase_ - 15.0));
  }

 private:
  double since_ = 0.0;  // [s], time since the last sample
  double phase_ = 1.0;
  bool rests_ = true;
  bool held_ = false;
};

}  // namespace reckon::haptics
