// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Boundary loops, from OpenMesh's half-edges.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include "reckon/haptics/geometry/mesh_repair.hpp"

namespace reckon::haptics {

namespace {

using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;

HalfEdges half_edges_of(const TriangleSoup& soup) {
  HalfEdges mesh;
  const std::size_t triangles = soup.triangles.size();
  mesh.reserve(soup.vertices.size(), 3 * triangles / 2, triangles);
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) mesh.new_vertex();
  omerr().disable();  // it prints every face that it cannot join
  for (const SoupTriangle& triangle : soup.triangles) {
    const auto vertex = [&](std::size_t i) {
      return HalfEdges::VertexHandle(static_cast<int>(triangle.corners[i]));
    };
    mesh.add_face(vertex(0), vertex(1), vertex(2));
  }
  omerr().enable();
  return mesh;
}

}  // namespace

std::size_t count_holes(const TriangleSoup& soup) {
  const HalfEdges mesh = half_edges_of(soup);
  std::vector<bool> seen(mesh.n_halfedges());
  std::size_t holes = 0;
  for (const auto edge : mesh.halfedges()) {
    if (!mesh.is_boundary(edge) || seen[static_cast<std::size_t>(edge.idx())]) continue;
    ++holes;
    for (HalfEdges::HalfedgeHandle at = edge; !seen[static_cast<std::size_t>(at.idx())];
         at = mesh.next_halfedge_handle(at)) {
      seen[static_cast<std::size_t>(at.idx())] = true;
    }
  }
  return holes;
}

}  // namespace reckon::haptics
