// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How warm the motors of a device are, and what they may show.
#pragma once

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

/// The motors as one body that their current warms and that cools by itself, as drives reckon it
/// ("I2t"): warmth h, 0 cold and 1 what they bear, follows h' = ((F / F_c)^2 - h) / tau for a force
/// F, of which F_c is held for ever. F may be at most F_c sqrt(h + kQuick (1 - h)), so h never
/// passes 1, and near it the limit goes down to F_c within some tau / kQuick. No thread, some ns a
/// step.
class MotorHeat {
 public:
  /// Shares of its thermal time constant in which a motor that has become warm goes down.
  static constexpr double kQuick = 50.0;

  /// Motors that show their greatest force for as long as one likes.
  MotorHeat() = default;
  /// @param continuous F_c as a share of the greatest force, > 0 @param steps tau in samples, at
  /// least kQuick
  MotorHeat(double continuous, double steps) noexcept
      : continuous_(std::min(continuous, 1.0)), rate_(1.0 / steps) {}

  /// Greatest force now, as a share of the greatest of all: continuous to 1.
  [[nodiscard]] double most() const noexcept {
    if (rate_ == 0.0) return 1.0;
    return std::min(1.0, continuous_ * std::sqrt(warmth_ + kQuick * (1.0 - warmth_)));
  }
  /// A sample passes in which this share of the greatest force was shown.
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
