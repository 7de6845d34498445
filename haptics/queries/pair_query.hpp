// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two shapes: whether they overlap, their distance and nearest points, the least translation that
// parts them, and when they meet.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "reckon/haptics/queries/hull_gap.hpp"
#include "reckon/haptics/queries/query_shape.hpp"

namespace reckon::haptics {

enum class Overlap : std::uint8_t { no, yes, unknown };

/// The true value is between both, limits included. Equal: it is exact, within rounding.
struct Bounds {
  double least = 0.0;
  double most = std::numeric_limits<double>::infinity();
};

/// What is known of two shapes, a and b. Frame S.
///
/// | pair                         | overlap                | distance       | depth |
/// |------------------------------|------------------------|----------------|----------------------|
/// | box, ball, capsule, plane    | exact; touching is no  | exact          | exact | | mesh -
/// plane                 | exact; touching is no  | exact          | exact                | | mesh
/// - box, ball, capsule    | exact; touching is yes | exact          | bounds               | |
/// mesh - mesh                  | exact; touching is yes | exact          | bounds               |
/// | solid - any                  | unknown within bounds  | bounds         | bounds |
///
/// Exact: within 1e-13 of the sizes and the distance. Inside of a mesh is only what a closed mesh
/// encloses. The bounds of a solid's distance are within 1e-6 sizes for a ball at a primitive and
/// mostly within 1 % for others; an upper one of depth is that of both bounding boxes, and
/// way_out() finds a better one.
struct PairMeasure {
  Overlap overlap = Overlap::unknown;
  Bounds distance;  ///< [m], >= 0; 0 where they overlap
  /// Nearest points, a pair of `distance.most`. Not set where the shapes overlap or it is infinite.
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero(), on_b = Eigen::Vector3d::Zero();
  Bounds depth;  ///< [m], >= 0, least translation that parts them; 0 where they do not overlap
  /// Unit, from a to b. Overlapping: a translation of b by depth.most along it parts the shapes
  /// (infinite: none is known). Else from on_a to on_b.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// What is kept between queries of one pair, in either order. It makes them faster, and changes
/// results by rounding at most. One thread at a time.
struct PairMemory {
  HullStart start;
  std::uint32_t triangle_a = 0, triangle_b = 0;
};

/// Cost: two boxes 0.7 us, a mesh 1 to 20 us, a solid 0.2 us (with a ball) to 100 us. noexcept, no
/// allocation. The same arguments give the same bits on every peer. Exchanged arguments give the
/// same result, to the bit, exchanged; except for equal shapes at one place, whose direction does
/// not change. Any finite placement; the error of S coordinates at a far place is that of a double.
[[nodiscard]] PairMeasure measure_pair(const QueryShape& a, const Placement& a_at,
                                       const QueryShape& b, const Placement& b_at) noexcept;
[[nodiscard]] PairMeasure measure_pair(const QueryShape& a, const Placement& a_at,
                                       const QueryShape& b, const Placement& b_at,
                                       PairMemory& memory) noexcept;

}  // namespace reckon::haptics
