// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distances of mesh surfaces, by bounding volume trees. In the axes of the (first) mesh, exact
// within rounding. noexcept, no allocation.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/haptics/queries/box_axes.hpp"
#include "reckon/haptics/queries/hull_gap.hpp"
#include "reckon/haptics/queries/query_shape.hpp"

namespace reckon::haptics {

/// From the surface to a solid box. `triangle` is a hint, any number, and becomes the nearest
/// triangle. Logarithmic in the triangles for a box of their size, 1 to 5 us; a box at nearly the
/// same distance from many triangles visits them all.
[[nodiscard]] HullGap mesh_box_gap(const SurfaceMesh& mesh, const OrientedBox& box,
                                   std::uint32_t& triangle) noexcept;

/// Between two surfaces; `b_at` is the placement of b. `hint_a`, `hint_b` as above.
[[nodiscard]] HullGap mesh_mesh_gap(const SurfaceMesh& a, const SurfaceMesh& b,
                                    const Placement& b_at, std::uint32_t& hint_a,
                                    std::uint32_t& hint_b) noexcept;

/// The lowest corner of the mesh along `up`.
[[nodiscard]] Eigen::Vector3d lowest_corner(const SurfaceMesh& mesh,
                                            const Eigen::Vector3d& up) noexcept;

}  // namespace reckon::haptics
