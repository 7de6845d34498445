// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A spring to the region's origin. A scene file sets it with `spring = {..}` of a region.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// A spring and a damper to a point.
struct Tether {
  double stiffness = 100.0;  ///< [N/m]
  double damping = 0.0;      ///< [N s/m]
  double most = 5.0;         ///< [N]
};

/// F = -stiffness place, at most `most`, and -damping v. On entry away from the origin, the loan
/// for regions pays for the stored energy, and beyond it the hand's motion.
class PointSpring : public CountedEffect<PointSpring> {
 public:
  using Parameters = Tether;
  static constexpr std::string_view kName = "point_spring";
  static constexpr std::string_view kKey = "spring";
  static constexpr std::string_view kCost = "one square root";
  static constexpr std::array<EffectParameter<Tether>, 3> kParameters{{
      {"stiffness", "N/m", &Tether::stiffness, 0.1, 1e5, 100.0,
       "Force to the region's origin per metre; higher is firmer."},
      {"damping", "N s/m", &Tether::damping, 0.0, 100.0, 0.0,
       "Force against motion inside the region per m/s; higher swings less."},
      {"most", "N", &Tether::most, 0.01, 100.0, 5.0, "The spring's largest force."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit PointSpring(const Tether& tether) : tether_(tether) {
    check_parameters(kParameters, tether);
  }

  /// Hook: 1/2 stiffness r^2, and beyond r0 = most / stiffness: most (r - r0 / 2).
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) const noexcept {
    if (!point.inside) return {};
    const double length = point.place.norm(), bend = tether_.most / tether_.stiffness;
    const double pull = length > bend ? tether_.most / length : tether_.stiffness;
    return {energy(length), -pull * point.place, tether_.stiffness};
  }
  /// Hook: potential at the farthest point [J].
  [[nodiscard]] double range(const RegionReach& reach) const noexcept {
    return energy(reach.farthest());
  }
  /// Hook [N/m].
  [[nodiscard]] double stiffness() const noexcept { return tether_.stiffness; }

  /// Hook: the damper [N].
  [[nodiscard]] Eigen::Vector3d force(const RegionPoint& point) const noexcept {
    return point.inside ? Eigen::Vector3d(-tether_.damping * point.velocity)
                        : Eigen::Vector3d::Zero();
  }

  [[nodiscard]] const Tether& parameters() const noexcept { return tether_; }

 private:
  [[nodiscard]] double energy(double length) const noexcept {
    const double near = std::min(length, tether_.most / tether_.stiffness);
    return 0.5 * tether_.stiffness * near * near + tether_.most * (length - near);
  }

  Tether tether_;
};

}  // namespace reckon::haptics
