// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// For how long a stated acceleration is believed while no update comes. The models of IEEE 1278.1
// follow it for ever: a ball that states 600 m/s^2 in the sample of its bounce is 300 m away after
// a second, if the next update is lost.
//
// The rule uses nothing but the update and its age. So an owner, a viewer and a viewer that has
// joined late compute the same pose.
#pragma once

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::deadreckon {

/// Change of velocity, in multiples of the stated one, for which an acceleration is trusted. A
/// lower value bounds the harm of a lost update more closely. A higher one lets an acceleration
/// from near rest, that goes on, do with fewer updates: each one trusts it for 1 + kTrustedChange
/// times as long as the last one.
inline constexpr double kTrustedChange = 4.0;

/// The time scale of a motion [s], times kTrustedChange: T = kTrustedChange |V| / |A|. Infinite if
/// the model has no acceleration or the acceleration is 0; 0 for one that starts from rest; NaN for
/// a state that is not finite.
[[nodiscard]] double acceleration_trust(const KinematicState& state) noexcept;

/// Whether the acceleration of `state` is no longer trusted `tau` [s] after the update. False for
/// NaN. Some 2 ns.
[[nodiscard]] bool is_beyond_trust(const KinematicState& state, double tau) noexcept;

/// Pose `tau` [s] after the update, as Reckon peers show each other's entities. Up to T it is that
/// of extrapolate(). From T to 2 T the acceleration acts in reverse, and the change of the velocity
/// goes back to 0 without a step; then the pose moves on at the stated velocity. So the
/// acceleration moves it by no more than |A| T^2 = kTrustedChange^2 |V|^2 / |A|. The orientation is
/// that of extrapolate(). In body axes the same holds for the components of the velocity. Finite
/// like extrapolate(). Any thread, no allocation.
[[nodiscard]] Pose extrapolate_trusted(const KinematicState& state, double tau) noexcept;

}  // namespace reckon::deadreckon
