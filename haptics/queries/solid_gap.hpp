// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bounds of the distance of an implicit solid: its signed function never exceeds the distance, and
// any found point of the solid bounds it from above. In the axes of the first solid. noexcept, no
// allocation; at most kMostPieces samples of each function, 20 to 100 us.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/queries/box_axes.hpp"
#include "reckon/haptics/queries/query_shape.hpp"

namespace reckon::haptics {

/// Bounds of a distance. Below 0: the shapes overlap, and no translation shorter than -most
/// separates them.
struct SolidGap {
  double least = 0.0;  ///< [m]
  double most = 0.0;   ///< [m]; infinite if no point of the solid was found
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();  ///< point of the first solid, if most is finite
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();  ///< |on_b - on_a| = most, if it is above 0
};

/// From a solid to a box.
[[nodiscard]] SolidGap solid_box_gap(const ImplicitSolid& solid, const OrientedBox& box) noexcept;

/// Between two solids; `b_at` is the placement of b.
[[nodiscard]] SolidGap solid_solid_gap(const ImplicitSolid& a, const ImplicitSolid& b,
                                       const Placement& b_at) noexcept;

/// From a solid to the surface of a mesh.
[[nodiscard]] SolidGap solid_mesh_gap(const ImplicitSolid& solid, const SurfaceMesh& mesh,
                                      const Placement& mesh_at) noexcept;

/// Height of the solid's lowest point along the unit vector `up`: least and most bound up . x; on_a
/// is the point of `most`. For one primitive they are within 1e-6 sizes.
[[nodiscard]] SolidGap lowest_of_solid(const ImplicitSolid& solid,
                                       const Eigen::Vector3d& up) noexcept;

}  // namespace reckon::haptics
