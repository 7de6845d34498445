// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When two moving shapes meet, by conservative advancement (B. Mirtich, 1996): time is advanced by
// what the distance proves to be free, again and again.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "reckon/haptics/queries/pair_query.hpp"

namespace reckon::haptics {

/// A shape that moves: its origin at a constant velocity, turning about it at a constant rate.
struct Motion {
  Placement start;                                      ///< at time 0
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< [m/s], S
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< [rad/s], S

  /// @param time [s]
  [[nodiscard]] Placement at(double time) const noexcept;
};

enum class Impact : std::uint8_t {
  none,     ///< free until the horizon
  hit,      ///< they come within the tolerance, or overlap from the start
  unknown,  ///< free until `time`; nothing is known of later
};

struct ImpactTime {
  Impact outcome = Impact::unknown;
  double time = 0.0;    ///< [s]; until here the shapes are surely apart. Never after the contact
  PairMeasure measure;  ///< at the last time that was looked at, `time` itself for a hit
};

/// Evaluations of the distance in one query, at most.
inline constexpr int kMostAdvances = 256;

/// The first contact within `horizon` [s] >= 0. A hit is at the time at which the distance has
/// fallen below `tolerance` [m], and before the contact.
///
/// Unknown is the answer for shapes that pass one another many times nearer than they move (it
/// needs more than kMostAdvances), for solids whose bounds of the distance are wider than the
/// tolerance, for a plane that turns, and for what is not finite. Convex pairs need 3 to 30
/// advances; one with a mesh or a solid needs more where it slides along, because only the speed
/// and not its direction counts.
///
/// @param tolerance [m] > 0; raising it makes the answer sooner and cheaper. At least 1e-12 of the
/// sizes. noexcept, no allocation; cost: advances x measure_pair().
[[nodiscard]] ImpactTime time_of_impact(const QueryShape& a, const Motion& a_moves,
                                        const QueryShape& b, const Motion& b_moves, double horizon,
                                        double tolerance = 1e-6) noexcept;

}  // namespace reckon::haptics
