// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A viscous medium, as water or honey. A scene file sets it with `viscosity = {..}` of a region.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Of a medium.
struct Medium {
  double linear = 5.0;     ///< [N s/m]
  double quadratic = 0.0;  ///< [N s^2/m^2]
};

/// F = -(linear + quadratic |v|) v.
class Viscosity : public CountedEffect<Viscosity> {
 public:
  using Parameters = Medium;
  static constexpr std::string_view kName = "viscosity";
  static constexpr std::string_view kKey = "viscosity";
  static constexpr std::string_view kCost = "one square root";
  static constexpr std::array<EffectParameter<Medium>, 2> kParameters{{
      {"linear", "N s/m", &Medium::linear, 0.0, 100.0, 5.0,
       "Force against the motion per m/s; higher is thicker."},
      {"quadratic", "N s2/m2", &Medium::quadratic, 0.0, 1000.0, 0.0,
       "The same per square of the speed, as for a large body in water."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit Viscosity(const Medium& medium) : medium_(medium) {
    check_parameters(kParameters, medium);
  }

  /// Hook: the drag [N].
  [[nodiscard]] Eigen::Vector3d force(const RegionPoint& point) const noexcept {
    if (!point.inside) return Eigen::Vector3d::Zero();
    return -(medium_.linear + medium_.quadratic * point.velocity.norm()) * point.velocity;
  }

  [[nodiscard]] const Medium& parameters() const noexcept { return medium_; }

 private:
  Medium medium_;
};

}  // namespace reckon::haptics
