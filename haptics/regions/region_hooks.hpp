// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hooks of an effect of a region: a part of space, or all of it, where a device feels a force
// without contact.
//
//   potential(point)          stores energy, as a spring does
//   range(reach)              with potential(): a source, whose storage a loan pays for
//   sink(point, most)         with potential(): lowers the zero of the potential
//   shake(point)              an oscillating force, paid for by a bucket of energy
//   force(point)              any other force on the device
#pragma once

#include <Eigen/Core>
#include <concepts>

#include "reckon/haptics/effects/effect_hooks.hpp"

namespace reckon::haptics {

/// State of the device in a region, for each servo step.
struct RegionPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< in the region's axes [m]
  Eigen::Vector3d beyond = Eigen::Vector3d::Zero();    ///< from the nearest point inside [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< in the region's axes [m/s]
  double dt = 0.001;                                   ///< [s], hold time of the force
  bool inside = true;
  bool entered = false;  ///< it was outside in the last step, or the servo has just started
};

/// A potential at a point.
struct RegionPotential {
  double energy = 0.0;                              ///< [J] >= 0
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< -grad energy [N], in the region's axes
  double stiffness = 0.0;                           ///< [N/m], upper bound of its curvature
};

/// Range of a device's positions in a region, in the region's axes.
struct RegionReach {
  Eigen::Vector3d least = Eigen::Vector3d::Zero(), most = Eigen::Vector3d::Zero();  ///< [m], inside
  double beyond = 0.0;  ///< [m], greatest distance outside

  /// Greatest distance from the region's origin [m].
  [[nodiscard]] double farthest() const noexcept {
    return least.cwiseAbs().cwiseMax(most.cwiseAbs()).norm();
  }
};

/// Stores energy. The energy may fall by itself, as in sliding friction, but grows only by motion
/// of the device against the force. Exception: on entry, its share begins at the energy that the
/// ledger covers, for LendsRegionEnergy plus the loan for regions. Called once a step, inside or
/// not.
template <class Effect>
concept StoresRegionEnergy = requires(Effect& effect, const Effect& fixed,
                                      const RegionPoint& point) {
  { effect.potential(point) }
  noexcept->std::same_as<RegionPotential>;
  { fixed.stiffness() }
  noexcept->std::same_as<double>;
};

/// A potential that the region supplies: the port's loan for regions pays if it begins above 0.
/// range() is the greatest energy that it can store within reach [J].
template <class Effect>
concept LendsRegionEnergy = StoresRegionEnergy<Effect> &&
    requires(const Effect& fixed, const RegionReach& reach) {
  { fixed.range(reach) }
  noexcept->std::same_as<double>;
};

/// A potential without a fixed zero: the zero falls with the hand, so the energy at the point
/// grows, by at most `most` [J]. @return that growth. Called after potential().
template <class Effect>
concept SinksInRegion = requires(Effect& effect, const RegionPoint& point, double most) {
  { effect.sink(point, most) }
  noexcept->std::same_as<RegionPotential>;
};

/// Gives a force as a function of time [N, region's axes], see OscillationBucket.
template <class Effect>
concept ShakesRegion = requires(Effect& effect, const RegionPoint& point) {
  { effect.shake(point) }
  noexcept->std::same_as<Eigen::Vector3d>;
};

/// Gives any other force [N, region's axes], as far as the device's ledger covers it.
template <class Effect>
concept GivesRegionForce = requires(Effect& effect, const RegionPoint& point) {
  { effect.force(point) }
  noexcept->std::same_as<Eigen::Vector3d>;
};

/// Declares that it acts outside the region too, which therefore needs a shape. Another effect is
/// not called there.
template <class Effect>
concept ActsOutside = requires {
  requires Effect::kActsOutside;
};

template <class Effect>
concept HookedRegionEffect =
    StoresRegionEnergy<Effect> || GivesRegionForce<Effect> || ShakesRegion<Effect>;

/// Each hook that the effect names is complete and has the right types.
template <class Effect>
concept WholeRegionHooks = (StoresRegionEnergy<Effect> || !(
                                                              requires { &Effect::potential; } ||
                                                              requires { &Effect::stiffness; })) &&
                           (GivesRegionForce<Effect> || !requires { &Effect::force; });

}  // namespace reckon::haptics
