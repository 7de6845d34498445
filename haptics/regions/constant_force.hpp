// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A constant force, as wind or the weight of a tool. A scene file sets it with
// `constant_force = {..}` of a region.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Along the region's axes.
struct Push {
  double x = 0.0, y = 0.0, z = 0.0;  ///< [N]
};

/// A potential that is linear from rise() above its reference on. The reference is rise() along the
/// force from the lowest point that the hand has reached since its entry. The loan for regions pays
/// for that, then the ledger. The part that is not stored is rendered as far as the device's
/// damping and ledger cover it.
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
  /// Shortest distance over which the stored part grows to the whole force [m], and the greatest
  /// stiffness [N/m], which makes it longer for more than 0.75 N. A higher stiffness stores less at
  /// rest, and more devices are too weak for it.
  static constexpr double kShortestRise = 0.005;
  static constexpr double kStiffest = 150.0;

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit ConstantForce(const Push& push)
      : push_(push),
        force_(push.x, push.y, push.z),
        size_(force_.norm()),
        rise_(std::max(kShortestRise, size_ / kStiffest)) {
    check_parameters(kParameters, push);
  }

  /// Hook: with the distance h from the reference against the force: size h^2 / (2 rise), and from
  /// rise on size (h - rise / 2).
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) noexcept {
    if (!point.inside || !(size_ > 0.0)) return {};
    const double along = -point.place.dot(force_) / size_;
    if (point.entered) {
      lowest_ = along;
      margin_ = 0.0;
    }
    lowest_ = std::min(lowest_, along);
    return at(along - lowest_);
  }
  /// Hook: lowers the reference to rise() below the point, over kFadeSeconds from the entry.
  [[nodiscard]] RegionPotential sink(const RegionPoint& point, double most) noexcept {
    if (!point.inside || !(size_ > 0.0)) return {};
    margin_ = std::min(rise_, margin_ + rise_ * point.dt / kFadeSeconds);
    const double way = -point.place.dot(force_) / size_ - lowest_;
    if (!(way < margin_)) return {};
    const double before = energy(way), share = stored_;
    const double goal = std::min(margin_, way_of(before + most));
    if (!(goal > way)) return {};
    lowest_ -= goal - way;
    const RegionPotential after = at(goal);
    return {after.energy - before, (stored_ - share) * force_, 0.0};
  }
  /// Hook: from end to end along the force [J].
  [[nodiscard]] double range(const RegionReach& reach) const noexcept {
    return force_.cwiseAbs().dot(reach.most - reach.least);
  }
  /// Hook [N/m].
  [[nodiscard]] double stiffness() const noexcept { return size_ / rise_; }
  /// Distance over which the stored part grows to the whole force [m].
  [[nodiscard]] double rise() const noexcept { return rise_; }

  /// Hook: the part that is not stored [N]. Called after potential().
  [[nodiscard]] Eigen::Vector3d force(const RegionPoint& point) const noexcept {
    return point.inside ? Eigen::Vector3d((1.0 - stored_) * force_) : Eigen::Vector3d::Zero();
  }

  [[nodiscard]] const Push& parameters() const noexcept { return push_; }

 private:
  static constexpr double kFadeSeconds = 0.1;

  [[nodiscard]] double energy(double way) const noexcept {
    const double rising = std::min(way, rise_);
    return size_ * (0.5 * rising * rising / rise_ + way - rising);
  }
  // Distance up to rise() that stores this energy [m].
  [[nodiscard]] double way_of(double energy) const noexcept {
    return std::min(rise_, std::sqrt(2.0 * rise_ * energy / size_));
  }
  [[nodiscard]] RegionPotential at(double way) noexcept {
    stored_ = std::min(1.0, way / rise_);
    return {energy(way), stored_ * force_, stiffness()};
  }

  Push push_;
  Eigen::Vector3d force_;
  double size_;
  double rise_;
  double lowest_ = 0.0;  // [m], the reference, as a coordinate against the force
  double stored_ = 0.0;  // stored share of the force
  double margin_ = 0.0;  // [m], distance of the reference below the lowest point
};

}  // namespace reckon::haptics
