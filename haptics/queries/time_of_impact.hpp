// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time of impact of two moving shapes, by conservative advancement (B. Mirtich, 1996): repeatedly
// advances the time by a step that the distance proves to be free.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "reckon/haptics/queries/pair_query.hpp"

namespace reckon::haptics {

/// Constant velocity of a shape's origin, and constant rotation about it.
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
  unknown,  ///< free until `time`; later unknown
};

struct ImpactTime {
  Impact outcome = Impact::unknown;
  double time = 0.0;    ///< [s]; the shapes are surely apart until then. Never after the contact
  PairMeasure measure;  ///< at the last evaluated time; for a hit at `time`
  int advances = 0;     ///< distance evaluations
};

/// Greatest number of distance evaluations in one query.
inline constexpr int kMostAdvances = 256;

/// The first contact within `horizon` [s] >= 0. A hit is when the distance has fallen below
/// `tolerance` [m], before the contact.
///
/// The result is `unknown` for shapes that pass at a distance much smaller than their motion (more
/// than kMostAdvances), for solids with distance bounds wider than the tolerance, for a rotating
/// plane, and for values that are not finite. Convex pairs need 3 to 30 advances. Pairs with a mesh
/// or a solid need more if they slide past each other, because their bound ignores the direction of
/// motion.
///
/// @param tolerance [m] > 0; a larger value makes hits earlier and cheaper. At least 1e-12 of the
/// sizes. @param most advances, at most kMostAdvances; more: `unknown`. noexcept, no allocation;
/// cost: advances x measure_pair().
[[nodiscard]] ImpactTime time_of_impact(const QueryShape& a, const Motion& a_moves,
                                        const QueryShape& b, const Motion& b_moves, double horizon,
                                        double tolerance = 1e-6, int most = kMostAdvances) noexcept;

}  // namespace reckon::haptics
