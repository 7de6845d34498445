// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distance of two small convex polytopes: boxes, rectangles, segments, points, triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "reckon/haptics/geometry/triangle_query.hpp"

namespace reckon::haptics {

/// A box with three, two, one or no extents (8, 4, 2, 1 corners), or a triangle (3).
struct Hull {
  /// Two corners of a box whose numbers differ in one bit share an edge.
  std::array<Eigen::Vector3d, 8> corners;
  std::uint8_t count = 0;

  /// @param half half edges [m], each >= 0; values below 1e-150 m count as 0
  [[nodiscard]] static Hull of_box(const Eigen::Vector3d& centre, const Eigen::Matrix3d& axes,
                                   const Eigen::Vector3d& half) noexcept;
  [[nodiscard]] static Hull of_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c) noexcept;
  /// The point of the hull nearest to p.
  [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& p) const noexcept;
};

/// Result of the last search of a pair, as start of the next one. It saves time and changes results
/// only within rounding. One for each pair; default: none yet.
struct HullStart {
  std::array<std::uint8_t, 4> a{}, b{};  ///< corners
  std::uint8_t count = 0;
};

/// A nearest pair of points; they are equal if the hulls intersect.
struct HullGap {
  double distance = 0.0;  ///< [m]
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// Distance of two hulls, 0 if they intersect, within 1e-13 of the farthest corner from the origin.
/// The algorithm of Gilbert, Johnson and Keerthi (1988), with a proof: if its supporting plane does
/// not confirm the distance, as between needles, all pairs of features are compared. 0.2 us, or 4
/// us with features. noexcept, no allocation.
[[nodiscard]] HullGap hull_gap(const Hull& a, const Hull& b, HullStart& start) noexcept;

/// The same by comparison of all features: corners with hulls, edges with edges and hulls.
[[nodiscard]] HullGap hull_gap_by_features(const Hull& a, const Hull& b) noexcept;

}  // namespace reckon::haptics
