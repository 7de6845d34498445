// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Queries of two shapes: overlap, distance and nearest points, and the least translation that
// separates them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "reckon/haptics/queries/hull_gap.hpp"
#include "reckon/haptics/queries/query_shape.hpp"

namespace reckon::haptics {

enum class Overlap : std::uint8_t { no, yes, unknown };

/// The true value is between both, inclusive. Equal bounds: exact within rounding.
struct Bounds {
  double least = 0.0;
  double most = std::numeric_limits<double>::infinity();
};

/// Result for two shapes, a and b. Frame S.
///  - Boxes, balls, capsules, planes, and a mesh with a plane: all values are exact. Touching is no
///    overlap.
///  - A mesh with a box, ball, capsule or mesh: overlap and distance are exact, touching is an
///    overlap, and depth has two bounds.
///  - An implicit solid with any shape: distance and depth have two bounds, and overlap is
///    unknown if these do not decide.
///
/// Exact means within 1e-13 of the sizes and the distance. Only a closed mesh has an inside. Width
/// of the bounds of a solid's distance, in its sizes, as median and 95th percentile of random
/// pairs:
///  - a ball 1e-14; a plane 5e-8; a convex primitive and a box, capsule, mesh or another such 1e-6;
///  - a ring or a plate with a bore, and a capsule or box: 3e-5 and 3e-3; a mesh or solid: 0.02 and
///    0.03;
///  - beside the rounded or mitred edges of an intersection, where its function itself is less than
///    the distance: 0.03 and 0.15.
/// The upper bound of depth is from the bounding boxes, unless a translation to the nearest surface
/// separates the shapes; way_out() finds a shorter one.
struct PairMeasure {
  Overlap overlap = Overlap::unknown;
  Bounds distance;  ///< [m], >= 0; 0 if they overlap
  /// Nearest points, at `distance.most`. Not set if the shapes overlap or the distance is infinite.
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero(), on_b = Eigen::Vector3d::Zero();
  Bounds depth;  ///< [m], >= 0, least separating translation; 0: no overlap
  /// Unit, from a to b. If they overlap: a translation of b by depth.most along it separates the
  /// shapes (infinite: none known). Otherwise from on_a to on_b.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// Cache between queries of one pair, in either order. It makes them faster, and changes results
/// only within rounding. One thread at a time.
struct PairMemory {
  HullStart start;
  std::uint32_t triangle_a = 0, triangle_b = 0;
};

/// Cost: two boxes 0.7 us, a mesh 1 to 20 us, a solid 0.2 us (with a ball) to 100 us. noexcept, no
/// allocation. The same arguments give the same bits on every peer. Swapped arguments give the
/// swapped result to the bit, except that the direction of equal shapes at one placement does not
/// change. Any finite placement; S coordinates far from the origin have the error of a double.
[[nodiscard]] PairMeasure measure_pair(const QueryShape& a, const Placement& a_at,
                                       const QueryShape& b, const Placement& b_at) noexcept;
[[nodiscard]] PairMeasure measure_pair(const QueryShape& a, const Placement& a_at,
                                       const QueryShape& b, const Placement& b_at,
                                       PairMemory& memory) noexcept;

}  // namespace reckon::haptics
