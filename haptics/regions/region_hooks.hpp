// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hooks of an effect of a region: a part of space, or all of it, in which a device feels a
// force without touching anything.
//
//   potential(point)          stores energy, as a spring does
//   range(reach)              besides: it is a source, so that a loan pays for what it stores
//   sink(point, most)         besides: lowers the place where it stores nothing
//   shake(point)              a force that its own bucket of energy pays for
//   force(point)              any other force on the device
#pragma once

#include <Eigen/Core>
#include <concepts>

#include "reckon/haptics/effects/effect_hooks.hpp"

namespace reckon::haptics {

/// The device in a region, once a servo step.
struct RegionPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< in the region's axes [m]
  Eigen::Vector3d beyond = Eigen::Vector3d::Zero();    ///< from the nearest place inside [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< in the region's axes [m/s]
  double dt = 0.001;                                   ///< [s], hold time of the force
  bool inside = true;
  bool entered = false;  ///< it was not inside one step before, or the servo has just begun
};

/// A potential at a point.
struct RegionPotential {
  double energy = 0.0;                              ///< [J] >= 0
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< -grad energy [N], in the region's axes
  double stiffness = 0.0;                           ///< [N/m], upper bound of its curvature
};

/// Where a device may be in a region, in the region's axes.
struct RegionReach {
  Eigen::Vector3d least = Eigen::Vector3d::Zero(), most = Eigen::Vector3d::Zero();  ///< [m], inside
  double beyond = 0.0;  ///< [m], greatest way outside

  /// Greatest distance from the region's origin [m].
  [[nodiscard]] double farthest() const noexcept {
    return least.cwiseAbs().cwiseMax(most.cwiseAbs()).norm();
  }
};

/// Stores energy. The energy may fall by itself, as where friction slides, but never grow without a
/// motion of the device against the force, except where it enters the region: then its share begins
/// at what the ledger covers, and for LendsRegionEnergy the loan for regions. Called once a step,
/// inside or not.
template <class Effect>
concept StoresRegionEnergy = requires(Effect& effect, const Effect& fixed,
                                      const RegionPoint& point) {
  { effect.potential(point) }
  noexcept->std::same_as<RegionPotential>;
  { fixed.stiffness() }
  noexcept->std::same_as<double>;
};

/// A potential that a region brings with it: the port's loan for regions pays where it begins at
/// more than 0. range() is the most that it can store within reach [J].
template <class Effect>
concept LendsRegionEnergy = StoresRegionEnergy<Effect> &&
    requires(const Effect& fixed, const RegionReach& reach) {
  { fixed.range(reach) }
  noexcept->std::same_as<double>;
};

/// Its potential has no least place of its own: the zero of the potential goes down as the hand
/// sinks, so that the energy at the point grows, by at most `most` [J]. @return that growth. Called
/// after potential().
template <class Effect>
concept SinksInRegion = requires(Effect& effect, const RegionPoint& point, double most) {
  { effect.sink(point, most) }
  noexcept->std::same_as<RegionPotential>;
};

/// Gives a force with time [N, region's axes], see OscillationBucket.
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

template <class Effect>
concept HookedRegionEffect =
    StoresRegionEnergy<Effect> || GivesRegionForce<Effect> || ShakesRegion<Effect>;

/// Each hook whose name it has is complete and has the right types.
template <class Effect>
concept WholeRegionHooks = (StoresRegionEnergy<Effect> || !(
                                                              requires { &Effect::potential; } ||
                                                              requires { &Effect::stiffness; })) &&
                           (GivesRegionForce<Effect> || !requires { &Effect::force; });

}  // namespace reckon::haptics
