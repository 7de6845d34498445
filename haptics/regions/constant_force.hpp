// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A constant force, as wind or the weight of a tool. A scene file sets it with
// `constant_force = {..}` of a region.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Along the region's axes.
struct Push {
  double x = 0.0, y = 0.0, z = 0.0;  ///< [N]
};

/// What the hand lifts against the force is stored and comes back. Where the hand is farther with
/// the force than ever since it entered, nothing is stored: there the force is shown as far as the
/// device's own damping and its ledger pay, at rest whole.
class ConstantForce : public CountedEffect<ConstantForce> {
 public:
  using Parameters = Push;
  static constexpr std::string_view kName = "constant_force";
  static constexpr std::string_view kKey = "constant_force";
  static constexpr std::string_view kCost = "a few multiplications";
  static constexpr std::array<EffectParameter<Push>, 3> kParameters{{
      {"x", "N", &Push::x, -20.0, 20.0, 0.0, "Along the region's x axis."},
      {"y", "N", &Push::y, -20.0, 20.0, 0.0, "Along the region's y axis."},
      {"z", "N", &Push::z, -20.0, 20.0, 0.0, "Along the region's z axis; weight is negative."},
  }};
  /// Way over which the stored part grows to the whole force [m].
  static constexpr double kRise = 0.005;

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit ConstantForce(const Push& push)
      : push_(push), force_(push.x, push.y, push.z), size_(force_.norm()) {
    check_parameters(kParameters, push);
  }

  /// Hook: of the way h against the force since its farthest point: size h^2 / (2 kRise), beyond
  /// kRise size (h - kRise / 2).
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) noexcept {
    if (!point.inside || !(size_ > 0.0)) return {};
    const double along = -point.place.dot(force_) / size_;
    if (point.entered) lowest_ = along;
    lowest_ = std::min(lowest_, along);
    const double way = along - lowest_, rising = std::min(way, kRise);
    stored_ = rising / kRise;
    return {size_ * (0.5 * rising * rising / kRise + way - rising), stored_ * force_, stiffness()};
  }
  /// Hook [N/m].
  [[nodiscard]] double stiffness() const noexcept { return size_ / kRise; }

  /// Hook: what is not stored [N]. Called after potential().
  [[nodiscard]] Eigen::Vector3d force(const RegionPoint& point) const noexcept {
    return point.inside ? Eigen::Vector3d((1.0 - stored_) * force_) : Eigen::Vector3d::Zero();
  }

  [[nodiscard]] const Push& parameters() const noexcept { return push_; }

 private:
  Push push_;
  Eigen::Vector3d force_;
  double size_;
  double lowest_ = 0.0;  // [m], least way against the force
  double stored_ = 0.0;  // share of the force
};

}  // namespace reckon::haptics
