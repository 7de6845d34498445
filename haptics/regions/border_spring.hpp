// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Walls of a workspace: a spring back into the region. A scene file sets it with `border = {..}` of
// a region.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Parameters of the walls.
struct Border {
  double stiffness = 300.0;  ///< [N/m]
};

/// F = stiffness times the vector to the nearest point inside.
class BorderSpring : public CountedEffect<BorderSpring> {
 public:
  using Parameters = Border;
  static constexpr bool kActsOutside = true;
  static constexpr std::string_view kName = "border_spring";
  static constexpr std::string_view kKey = "border";
  static constexpr std::string_view kCost = "a few multiplications";
  static constexpr std::array<EffectParameter<Border>, 1> kParameters{{
      {"stiffness", "N/m", &Border::stiffness, 0.0, 1e5, 300.0,
       "Force back into the region per metre outside; higher is firmer."},
  }};

  /// @throws std::invalid_argument when the value is out of the table's range.
  explicit BorderSpring(const Border& border) : border_(border) {
    check_parameters(kParameters, border);
  }

  /// Hook: 1/2 stiffness |beyond|^2.
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) const noexcept {
    return {0.5 * border_.stiffness * point.beyond.squaredNorm(), -border_.stiffness * point.beyond,
            border_.stiffness};
  }
  /// Hook: potential at the farthest point outside [J].
  [[nodiscard]] double range(const RegionReach& reach) const noexcept {
    return 0.5 * border_.stiffness * reach.beyond * reach.beyond;
  }
  /// Hook [N/m].
  [[nodiscard]] double stiffness() const noexcept { return border_.stiffness; }

  [[nodiscard]] const Border& parameters() const noexcept { return border_; }

 private:
  Border border_;
};

}  // namespace reckon::haptics
