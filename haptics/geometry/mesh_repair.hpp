// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Triangles made ready to be touched: equal positions welded, what has no area or is there twice
// dropped, neighbours made to face the same side, closed pieces outwards. What is done is counted
// in a MeshReport. Private to SurfaceMesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/geometry/face_names.hpp"
#include "reckon/haptics/geometry/mesh_report.hpp"

namespace reckon::haptics {

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

/// Vertices at the same position become one; the others stay, unused.
void weld(TriangleSoup& soup, MeshReport& report);

/// Triangles with equal corners. A thin one of three corners still joins its neighbours: it stays.
void drop_collapsed(TriangleSoup& soup, MeshReport& report);

/// Of triangles with the same three corners, either way round, the first stays.
void drop_duplicates(TriangleSoup& soup, MeshReport& report);

/// Counts edges, holes and pieces; turns triangles so that neighbours run opposite ways along their
/// edge, in an open piece as the larger area did, in a closed one so that its volume is positive. A
/// closed piece within the box of another that was drawn consistently keeps its side: it may be a
/// cavity. Sorts 3 n edges.
void orient(TriangleSoup& soup, MeshReport& report);

/// Loops of edges that have one triangle, of a surface whose edges have two at most.
[[nodiscard]] std::size_t count_holes(const TriangleSoup& soup);

}  // namespace reckon::haptics
