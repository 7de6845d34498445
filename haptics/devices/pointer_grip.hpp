// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How firmly a hand that follows a pointer holds its device.
#pragma once

#include <algorithm>

namespace reckon::haptics {

/// Share of the grip's spring and damper, 0 .. 1: full until the first sample, and after rest(),
/// for then nobody points; full while samples hold it; else it fades, and comes back as smoothly.
/// Within kPatience + kFade = 0.29 s of the last sample nothing is left of it.
class PointerGrip {
 public:
  static constexpr double kPatience = 0.14;  ///< [s], longest way between samples that hold
  static constexpr double kFade = 0.15;      ///< [s], from all to nothing and back

  /// A sample: whether somebody holds the pointer.
  void take(bool held) noexcept {
    rests_ = false;
    held_ = held;
    since_ = 0.0;
  }

  /// Nobody points any more: as before the first sample.
  void rest() noexcept { rests_ = true; }

  /// @param h [s] >= 0
  void advance(double h) noexcept {
    since_ += h;
    phase_ = std::clamp(phase_ + (rests_ || holds() ? h : -h) / kFade, 0.0, 1.0);
  }

  /// Whether the pointer is held and its last sample is young.
  [[nodiscard]] bool holds() const noexcept { return held_ && since_ <= kPatience; }
  /// Before the first sample, and after rest().
  [[nodiscard]] bool rests() const noexcept { return rests_; }
  /// Since the last sample [s].
  [[nodiscard]] double since() const noexcept { return since_; }
  /// Minimum jerk between 0 and 1.
  [[nodiscard]] double share() const noexcept {
    return phase_ * phase_ * phase_ * (10.0 + phase_ * (6.0 * phase_ - 15.0));
  }

 private:
  double since_ = 0.0;  // [s], the last sample
  double phase_ = 1.0;
  bool rests_ = true;
  bool held_ = false;
};

}  // namespace reckon::haptics
