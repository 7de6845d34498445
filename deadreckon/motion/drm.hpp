// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The dead-reckoning models 0 to 9 of IEEE 1278.1: a pose from the last update and the time since.
//
// The input is always the last update and never the last frame, so that rounding does not
// accumulate.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// The two readings of the acceleration of RVB that are in use. They differ by w x v during a
/// rotation.
enum class AccelerationReading {
  component_rate,  ///< A_b = dVb/dt, rate of the body components of velocity. Reckon's reading.
  inertial         ///< A_b = a - w x Vb, with `a` the inertial acceleration in body axes.
};

/// Limit of the extrapolation [s], in both directions; longer times give the pose of this one.
inline constexpr double kLongestExtrapolation = 1e6;

/// `tau` limited to that bound; NaN becomes 0, so that a bad clock shows the pose of the update.
[[nodiscard]] double bounded_tau(double tau) noexcept;

/// Meaning of the letters in a model's name.
struct DrmTerms {
  bool velocity;      ///< The position moves (FPW and up).
  bool acceleration;  ///< The velocity changes (second letter V).
  bool rotation;      ///< The orientation rotates (first letter R).
  bool body_axes;     ///< Velocity and acceleration are in body axes (third letter B).
};

/// THE list of the models, by number.
inline constexpr std::array<DrmTerms, 10> kDrmTerms = {{
    {false, false, false, false},  // 0 other
    {false, false, false, false},  // 1 static
    {true, false, false, false},   // 2 FPW
    {true, false, true, false},    // 3 RPW
    {true, true, true, false},     // 4 RVW
    {true, true, false, false},    // 5 FVW
    {true, false, false, true},    // 6 FPB
    {true, false, true, true},     // 7 RPB
    {true, true, true, true},      // 8 RVB
    {true, true, false, true},     // 9 FVB
}};

/// The terms of a model; `other`, `static_` and numbers not in the standard have none.
[[nodiscard]] constexpr DrmTerms drm_terms(pdu::DeadReckoningAlgorithm algorithm) noexcept {
  const auto row = static_cast<std::size_t>(algorithm);
  return row < kDrmTerms.size() ? kDrmTerms[row] : kDrmTerms[0];
}

/// Whether the pose stays constant: all terms that the model of `state` uses are zero.
[[nodiscard]] bool stands_still(const KinematicState& state) noexcept;

/// Pose `tau` seconds after the update, or before it if negative.
///
/// Position: P0 + V t + A t^2/2 in reference axes, P0 + R0 (R1 Vb + R2 Ab) in body axes, with R1
/// and R2 as power series in (w t)^2 below w t = 1 and in closed form above: exact at zero rate, no
/// gap at tiny ones. FPB and FVB ignore angular velocity: a frame that does not turn has none.
/// Finite for every state whose components a float32 can hold; NaN `tau` counts as 0. A state that
/// is not finite gives a pose that is not: reject it at reception (is_finite). Any thread; about 50
/// ns for RVB. Source: IEEE 1278.1 dead-reckoning models; docs/dead_reckoning.md.
[[nodiscard]] Pose extrapolate(
    const KinematicState& state, double tau,
    AccelerationReading reading = AccelerationReading::component_rate) noexcept;

}  // namespace reckon::deadreckon
