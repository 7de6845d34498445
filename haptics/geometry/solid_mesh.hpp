// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The surface of a solid as triangles, for what does not know its function.
#pragma once

#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// Dual contouring: one corner in each cell of a grid that the surface crosses, where the planes of
/// its crossings meet, so that edges stay sharp. Closed. What is thinner than a cell may be lost;
/// elsewhere the corners are on the surface, and the triangles within h^2 / 4 of its curvature, h
/// the edge of a cell. 0.1 us for each of the grid's places, 2 us for each triangle.
/// @param cells along the longest side of its bounds, 4 to 256
/// @throws std::invalid_argument "has no end", "is too thin for .. cells"
[[nodiscard]] SurfaceMesh mesh_of(const ImplicitSolid& solid, int cells = 32);

}  // namespace reckon::haptics
