// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Dry friction of a medium, like sand or a joint: the same force at any speed, and stiction at
// rest. A scene file sets it with `dry_friction = {..}` of a region.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Parameters of a medium.
struct Yield {
  double force = 0.5;        ///< [N]
  double stiffness = 150.0;  ///< [N/m], of the stiction
};

/// A bristle: a spring to an anchor, which follows so that the spring never exceeds the force.
class DryFriction : public CountedEffect<DryFriction> {
 public:
  using Parameters = Yield;
  static constexpr std::string_view kName = "dry_friction";
  static constexpr std::string_view kKey = "dry_friction";
  static constexpr std::string_view kCost = "one square root";
  static constexpr std::array<EffectParameter<Yield>, 2> kParameters{{
      {"force", "N", &Yield::force, 0.0, 20.0, 0.5, "Force against any motion; higher holds more."},
      {"stiffness", "N/m", &Yield::stiffness, 1.0, 1e5, 150.0,
       "Of the hold at rest; it yields after force / stiffness."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit DryFriction(const Yield& yield) : yield_(yield) { check_parameters(kParameters, yield); }

  /// Hook: 1/2 stiffness |place - anchor|^2, at most force^2 / (2 stiffness).
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) noexcept {
    if (!point.inside) return {};
    if (point.entered) anchor_ = point.place;
    Eigen::Vector3d way = point.place - anchor_;
    const double length = way.norm(), most = yield_.force / yield_.stiffness;
    if (length > most) {
      way *= most / length;
      anchor_ = point.place - way;
    }
    return {0.5 * yield_.stiffness * way.squaredNorm(), -yield_.stiffness * way, yield_.stiffness};
  }
  /// Hook: greatest energy of the bristle [J]. The loan for regions pays if it begins stretched;
  /// otherwise a region with other potentials would wait for the hand's energy.
  [[nodiscard]] double range(const RegionReach& /*reach*/) const noexcept {
    return 0.5 * yield_.force * yield_.force / yield_.stiffness;
  }
  /// Hook [N/m].
  [[nodiscard]] double stiffness() const noexcept { return yield_.stiffness; }

  [[nodiscard]] const Yield& parameters() const noexcept { return yield_; }

 private:
  Yield yield_;
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
