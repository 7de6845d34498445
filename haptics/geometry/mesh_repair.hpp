// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Repair of a triangle set for contact. Equal positions are welded, degenerate and repeated
// triangles dropped. Neighbours are turned to face the same side, and closed pieces outwards. A
// MeshReport counts all changes. Private to SurfaceMesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/geometry/face_names.hpp"
#include "reckon/haptics/geometry/mesh_report.hpp"

namespace reckon::haptics {

/// More have no numbers for their corners.
inline constexpr std::size_t kMostTriangles = 1 << 30;

struct SoupTriangle {
  std::array<std::uint32_t, 3> corners{};
  std::uint32_t place = 0;  ///< as MeshFinding::first
  FaceNames names{};
};

struct TriangleSoup {
  std::vector<Eigen::Vector3d> vertices;  ///< [m]
  std::vector<SoupTriangle> triangles;
  std::vector<std::string> names;  ///< as SurfaceMesh::names()
};

/// Merges vertices at the same position, and numbers them in the order of their first appearance.
void weld(TriangleSoup& soup, MeshReport& report);

/// Drops triangles with equal corners. A thin one with three corners stays, because it still joins
/// its neighbours.
void drop_collapsed(TriangleSoup& soup, MeshReport& report);

class VertexCorners;

/// Keeps the first of several triangles with the same three corners in either direction.
/// @return whether any was dropped; then `corners`, of this soup, are no longer valid
bool drop_duplicates(TriangleSoup& soup, const VertexCorners& corners, MeshReport& report);

/// Counts edges, holes and pieces. Turns triangles so that neighbours run in opposite directions
/// along their common edge: in an open piece as the larger area was drawn, in a closed one so that
/// its volume is positive. A closed piece that was drawn consistently and lies within the box of
/// another keeps its side, because it may be a cavity. Linear, unless many triangles share a
/// vertex.
/// @param corners of this soup
void orient(TriangleSoup& soup, VertexCorners corners, MeshReport& report);

/// Number of loops of edges with one triangle, for a surface with at most two triangles at an edge.
[[nodiscard]] std::size_t count_holes(const TriangleSoup& soup);

}  // namespace reckon::haptics
