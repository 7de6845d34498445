// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes triangles of a solid's surface, for code that cannot use its function.
#pragma once

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// Dual contouring: one corner in each grid cell that the surface crosses, at the intersection of
/// the planes of its crossings, so edges stay sharp. The result is closed. Parts thinner than a
/// cell may be lost. Elsewhere the corners are on the surface, and the triangles within h^2 / 4
/// times its curvature, for cells of edge h. 0.1 us for each grid point, 2 us for each triangle.
/// @param cells along the longest side of its bounds, 4 to 256
/// @throws std::invalid_argument "has no end", "is too thin for .. cells"
[[nodiscard]] SurfaceMesh mesh_of(const ImplicitSolid& solid, int cells = 32);

}  // namespace reckon::haptics
