// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thermal model of a device's motors, and the force that it allows.
#pragma once

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

/// The motors are one thermal mass, as in drives ("I2t"). Its warmth h, from 0 (cold) to 1 (limit),
/// follows h' = ((F / F_c)^2 - h) / tau for a force F, where F_c is the continuous force. F may be
/// at most F_c sqrt(h + kQuick (1 - h)), so h never exceeds 1, and near 1 the limit falls to F_c
/// within about tau / kQuick. No thread, some ns a step.
class MotorHeat {
 public:
  /// Divisor of the thermal time constant for the fall of the limit of a warm motor.
  static constexpr double kQuick = 50.0;

  /// Motors without a thermal limit.
  MotorHeat() = default;
  /// @param continuous F_c as a share of the greatest force, > 0 @param steps tau in samples, at
  /// least kQuick
  MotorHeat(double continuous, double steps) noexcept
      : continuous_(std::min(continuous, 1.0)), rate_(1.0 / steps) {}

  /// Present limit, as a share of the greatest force: continuous to 1.
  [[nodiscard]] double most() const noexcept {
    if (rate_ == 0.0) return 1.0;
    return std::min(1.0, continuous_ * std::sqrt(warmth_ + kQuick * (1.0 - warmth_)));
  }
  /// Advances by a sample with this share of the greatest force.
  void pass(double shown) noexcept {
    const double load = shown / continuous_;
    warmth_ += rate_ * (load * load - warmth_);
  }
  [[nodiscard]] double warmth() const noexcept { return warmth_; }  ///< 0 to 1

 private:
  double continuous_ = 1.0;
  double rate_ = 0.0;
  double warmth_ = 0.0;
};

}  // namespace reckon::haptics
