// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What was found in a mesh and what was done about it, as numbers and as sentences: nothing is
// mended, left out or scaled without a report.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::haptics {

/// How often something was found, and where first.
struct MeshFinding {
  std::size_t count = 0;
  std::uint32_t first = 0;  ///< place, from 1, in what MeshReport::place_word counts; 0: nowhere

  void add(std::uint32_t place) noexcept {
    if (count++ == 0 || place < first) first = place;
  }
};

struct MeshReport {
  std::string_view place_word = "triangle";  ///< "line" or "face" of a file, else "triangle"

  // Of what was given.
  std::size_t faces = 0;  ///< triangles and polygons
  MeshFinding polygons;   ///< of more than three corners, cut into triangles

  // Mended.
  std::size_t merged_vertices = 0;  ///< at the position of another
  MeshFinding dropped_degenerate;  ///< fewer than three different corners, or thinner than 1e-10 of
                                   ///< the size; their neighbours cover them
  MeshFinding dropped_duplicates;  ///< with the corners of another triangle, either way round
  MeshFinding turned;              ///< triangles that ran against their neighbours
  std::size_t inward_pieces = 0;   ///< closed, faced inwards as a whole, turned outwards

  // Left as it is.
  MeshFinding boundary_edges;         ///< of one triangle only; any makes the surface a shell
  std::size_t holes = 0;              ///< loops of boundary edges; 0 where edges are non-manifold
  MeshFinding non_manifold_edges;     ///< of three or more triangles
  MeshFinding non_manifold_vertices;  ///< where surfaces meet in a point only
  MeshFinding inconsistent_edges;     ///< whose two triangles run the same way, before turning
  std::size_t one_sided_edges = 0;    ///< where no turning helps, as on a Moebius strip

  // What is touched.
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t pieces = 0;                            ///< that no two-sided edge joins
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  ///< of the bounding box [m]
  double volume = 0.0;                               ///< enclosed [m^3]; 0 where it is not closed
  bool closed = false;  ///< no boundary and no non-manifold edge: there is an inside
};

/// One line: how large, how many triangles, closed or not, and what was mended harmlessly:
/// "200 x 150 x 80 mm, 5184 triangles, closed; 12 vertices merged, 3 polygons cut".
[[nodiscard]] std::string mesh_summary(const MeshReport& report);

/// What a person should look at, a sentence each with place, what was done and remedy: triangles
/// dropped, turned or twice, holes, edges of many triangles, a size that no hand can feel.
[[nodiscard]] std::vector<std::string> mesh_notes(const MeshReport& report);

/// "173 m", "2.5 mm", "4031 km": four digits.
[[nodiscard]] std::string length_text(double metres);

}  // namespace reckon::haptics
