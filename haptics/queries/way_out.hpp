// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds a short translation that separates two overlapping shapes, for tools that suggest a remedy.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "reckon/haptics/queries/query_shape.hpp"

namespace reckon::haptics {

/// Translation of the second shape.
struct WayOut {
  double way = std::numeric_limits<double>::infinity();  ///< [m]; 0: they do not overlap
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, S
};

/// Surely separates the shapes. For two boxes, balls, capsules or planes it is the least
/// translation, within rounding. For others it is the shortest one found along the axes of both
/// shapes and of S, and to the nearest surface; it may be longer than the least, and leaves a gap
/// of up to 1 um. Infinite if an unbounded solid allows none. Up to 20 times time_of_impact() and
/// 180 times measure_pair(); noexcept, no allocation.
[[nodiscard]] WayOut way_out(const QueryShape& a, const Placement& a_at, const QueryShape& b,
                             const Placement& b_at) noexcept;

}  // namespace reckon::haptics
