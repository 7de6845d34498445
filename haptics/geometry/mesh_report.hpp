// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Faults found in a mesh and their repair, as numbers and as sentences: every repair, omission and
// scaling is reported.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::haptics {

/// Count of a fault, and its first place.
struct MeshFinding {
  std::size_t count = 0;
  std::uint32_t first = 0;  ///< place, from 1, in units of MeshReport::place_word; 0: no place

  void add(std::uint32_t place) noexcept {
    if (count++ == 0 || place < first) first = place;
  }
};

struct MeshReport {
  std::string_view place_word = "triangle";  ///< "line" or "face" of a file, else "triangle"

  // Input.
  std::size_t faces = 0;          ///< triangles and polygons
  MeshFinding polygons;           ///< of more than three corners, cut into triangles
  std::size_t octets_behind = 0;  ///< of a binary STL, behind the faces that it counts

  // Repaired.
  std::size_t merged_vertices = 0;  ///< at the position of another
  MeshFinding dropped_degenerate;  ///< fewer than three different corners, or thinner than 1e-10 of
                                   ///< the size; their neighbours cover them
  MeshFinding dropped_duplicates;  ///< same corners as another triangle, in either direction
  MeshFinding turned;              ///< triangles that ran in the same direction as a neighbour
  std::size_t inward_pieces = 0;   ///< closed pieces that faced inwards and were turned

  // Left unchanged.
  MeshFinding boundary_edges;         ///< edges with one triangle; any makes the surface a shell
  std::size_t holes = 0;              ///< loops of boundary edges; 0 with non-manifold edges
  MeshFinding non_manifold_edges;     ///< edges with three or more triangles
  MeshFinding non_manifold_vertices;  ///< vertices at which surfaces meet in a point only
  MeshFinding inconsistent_edges;     ///< two triangles ran in the same direction before turning
  std::size_t one_sided_edges = 0;    ///< edges that no turning repairs, as on a Moebius strip

  // Result.
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t pieces = 0;                            ///< parts not joined by a two-sided edge
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< of the bounding box [m]
  double volume = 0.0;                               ///< enclosed [m^3]; 0 if not closed
  bool closed = false;  ///< no boundary and no non-manifold edge: the surface has an inside
};

/// One line: size, number of triangles, closed or not, and harmless repairs: "200 x 150 x 80 mm,
/// 5184 triangles, closed; 12 vertices merged, 3 polygons cut".
[[nodiscard]] std::string mesh_summary(const MeshReport& report);

/// Notices for the user, a sentence each with place, repair and remedy: triangles dropped, turned
/// or repeated, holes, edges with many triangles, a size that no hand can feel.
[[nodiscard]] std::vector<std::string> mesh_notes(const MeshReport& report);

/// "173 m", "2.5 mm", "4031 km": four digits.
[[nodiscard]] std::string length_text(double metres);

}  // namespace reckon::haptics
