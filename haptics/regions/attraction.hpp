// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A magnet: attracts the device to the region's origin, line or plane within a range. A scene file
// sets it with `magnet = {..}` of a region.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Parameters of a magnet. free_x = 1 lets the device move freely along x: with one free axis it
/// snaps to a line, with two to a plane.
struct Magnet {
  double force = 1.0;   ///< [N], greatest force
  double range = 0.02;  ///< [m]
  double free_x = 0.0;  ///< 0 or 1
  double free_y = 0.0;  ///< 0 or 1
  double free_z = 0.0;  ///< 0 or 1
};

/// F(r) = force sin(pi r / range) towards the origin, line or plane; 0 beyond the range. On entry
/// it pulls as strongly as the loan for regions and the hand's energy in the ledger cover. The
/// energy of the pull returns when the hand pulls out.
class Attraction : public CountedEffect<Attraction> {
 public:
  using Parameters = Magnet;
  static constexpr std::string_view kName = "attraction";
  static constexpr std::string_view kKey = "magnet";
  static constexpr std::string_view kCost = "one square root, a sine and a cosine";
  static constexpr std::array<EffectParameter<Magnet>, 5> kParameters{{
      {"force", "N", &Magnet::force, 0.0, 20.0, 1.0, "Greatest force, at half the range."},
      {"range", "m", &Magnet::range, 1e-3, 1.0, 0.02, "Greatest distance at which it attracts."},
      {"free_x", "", &Magnet::free_x, 0.0, 1.0, 0.0,
       "Ignored share of the distance along x; 1 snaps to the x axis."},
      {"free_y", "", &Magnet::free_y, 0.0, 1.0, 0.0, "The same along y."},
      {"free_z", "", &Magnet::free_z, 0.0, 1.0, 0.0, "The same along z."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit Attraction(const Magnet& magnet)
      : magnet_(magnet), held_(1 - magnet.free_x, 1 - magnet.free_y, 1 - magnet.free_z) {
    check_parameters(kParameters, magnet);
  }

  /// Hook: force range / pi (1 - cos(pi r / range)), r along the axes that are not free.
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) const noexcept {
    const Eigen::Vector3d way = held_.cwiseProduct(point.place);
    const double length = way.norm();
    if (!point.inside || !(length < magnet_.range)) return {};
    const double angle = std::numbers::pi * length / magnet_.range;
    const double energy = magnet_.force * magnet_.range / std::numbers::pi * (1 - std::cos(angle));
    const double pull = length > 0.0 ? magnet_.force * std::sin(angle) / length : 0.0;
    return {energy, -pull * held_.cwiseProduct(way), stiffness()};
  }
  /// Hook: the whole potential [J].
  [[nodiscard]] double range(const RegionReach& reach) const noexcept {
    const double length = std::min(reach.farthest(), magnet_.range);
    return magnet_.force * magnet_.range / std::numbers::pi *
           (1 - std::cos(std::numbers::pi * length / magnet_.range));
  }
  /// Hook [N/m].
  [[nodiscard]] double stiffness() const noexcept {
    return magnet_.force * std::numbers::pi / magnet_.range;
  }

  [[nodiscard]] const Magnet& parameters() const noexcept { return magnet_; }

 private:
  Magnet magnet_;
  Eigen::Vector3d held_;
};

}  // namespace reckon::haptics
