// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits the time for which the acceleration of an update is extrapolated without a new update. The
// models of IEEE 1278.1 have no limit: an update from the bounce of a ball may state 600 m/s^2, and
// if the next update is lost, the prediction is 300 m away after a second.
//
// The rule depends only on the update and its age. The owner, a viewer and a viewer that joined
// late therefore compute the same pose.
#pragma once

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::deadreckon {

/// Change of velocity, in multiples of the stated one, for which an acceleration is trusted. A
/// lower value bounds the error after a lost update more closely. With a higher value a lasting
/// acceleration from near rest needs fewer updates: each update trusts it for 1 + kTrustedChange
/// times as long as the previous one.
inline constexpr double kTrustedChange = 4.0;

/// The time scale of a motion [s], times kTrustedChange: T = kTrustedChange |V| / |A|. Infinite if
/// the model has no acceleration or the acceleration is 0; 0 for an acceleration from rest; NaN for
/// a state that is not finite.
[[nodiscard]] double acceleration_trust(const KinematicState& state) noexcept;

/// Whether the acceleration of `state` is no longer trusted `tau` [s] after the update. False for
/// NaN. Some 2 ns.
[[nodiscard]] bool is_beyond_trust(const KinematicState& state, double tau) noexcept;

/// Pose `tau` [s] after the update, as Reckon peers show each other's entities. Up to T it equals
/// extrapolate(). From T to 2 T the acceleration is reversed, and the velocity returns to the
/// stated one without a step; then the pose moves on at the stated velocity. The acceleration thus
/// moves the pose by no more than |A| T^2 = kTrustedChange^2 |V|^2 / |A|. The orientation always
/// equals extrapolate(). In body axes the same holds for the components of the velocity. Finite
/// like extrapolate(). Any thread, no allocation.
[[nodiscard]] Pose extrapolate_trusted(const KinematicState& state, double tau) noexcept;

}  // namespace reckon::deadreckon
