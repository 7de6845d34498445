// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force that oscillates in time, like an engine. A scene file sets it with `oscillation = {..}`
// of a region.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Along the region's axes.
struct Shaking {
  double x = 0.0, y = 0.0, z = 0.3;  ///< [N], amplitudes
  double frequency = 50.0;           ///< [Hz]
};

/// F = (x, y, z) sin(2 pi frequency t), with t from the entry of the device. The port's
/// OscillationBucket pays for it.
class Oscillation : public CountedEffect<Oscillation> {
 public:
  using Parameters = Shaking;
  static constexpr std::string_view kName = "oscillation";
  static constexpr std::string_view kKey = "oscillation";
  static constexpr std::string_view kCost = "a sine";
  static constexpr std::array<EffectParameter<Shaking>, 4> kParameters{{
      {"x", "N", &Shaking::x, 0.0, 20.0, 0.0, "Amplitude along the region's x axis."},
      {"y", "N", &Shaking::y, 0.0, 20.0, 0.0, "Amplitude along the region's y axis."},
      {"z", "N", &Shaking::z, 0.0, 20.0, 0.3, "Amplitude along the region's z axis."},
      {"frequency", "Hz", &Shaking::frequency, 0.1, 250.0, 50.0,
       "Frequency; above about 30 Hz it feels like vibration."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit Oscillation(const Shaking& shaking) : shaking_(shaking) {
    check_parameters(kParameters, shaking);
  }

  /// Hook: the force [N].
  [[nodiscard]] Eigen::Vector3d shake(const RegionPoint& point) noexcept {
    if (!point.inside) return Eigen::Vector3d::Zero();
    if (point.entered) turns_ = 0.0;
    turns_ += shaking_.frequency * point.dt;
    turns_ -= std::floor(turns_);
    return std::sin(2.0 * std::numbers::pi * turns_) *
           Eigen::Vector3d(shaking_.x, shaking_.y, shaking_.z);
  }

  [[nodiscard]] const Shaking& parameters() const noexcept { return shaking_; }

 private:
  Shaking shaking_;
  double turns_ = 0.0;
};

}  // namespace reckon::haptics
