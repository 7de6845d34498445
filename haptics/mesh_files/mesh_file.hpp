// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Content of a mesh file before any repair. Coordinates keep every digit of a double: a model in
// national coordinates is millions of metres from the origin, where single precision resolves half
// metres.
//
//   const MeshFile stone = read_mesh_file("scenes/touchstone.obj");
//   stone.vertices[stone.corners[stone.faces[0].first]]   // first corner of the first face
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::haptics {

/// One face: a polygon.
struct FileFace {
  std::size_t first = 0;       ///< of its corners in MeshFile::corners
  std::uint32_t count = 0;     ///< of its corners
  std::uint32_t place = 0;     ///< from 1: line of a text file, else number of the face
  std::uint32_t material = 0;  ///< in MeshFile::names, from 1; 0: none
  std::uint32_t group = 0;     ///< in MeshFile::names, from 1; 0: none
};

struct MeshFile {
  std::vector<Eigen::Vector3d> vertices;  ///< in the file's units, finite
  std::vector<std::uint32_t> corners;     ///< below vertices.size()
  std::vector<FileFace> faces;
  /// Names of materials and groups, in the order of their first appearance in the file. OBJ: the
  /// word after `usemtl`, and the first one after `g` or `o`; PLY: the number of a face's
  /// `material_index`.
  std::vector<std::string> names;
  std::string_view place_word = "line";  ///< unit of FileFace::place: "line" or "face"
  std::size_t merged_vertices = 0;       ///< of an STL: corners at the position of an earlier one
  std::size_t octets_behind = 0;         ///< of a binary STL, behind the faces that it counts

  [[nodiscard]] std::span<const std::uint32_t> corners_of(const FileFace& face) const noexcept {
    return {corners.data() + face.first, face.count};
  }
};

/// Reads a file according to its extension: .obj (polygons, relative indices), .ply (text and
/// binary, both byte orders), .stl (text and binary), .off (text). 0.3 us a triangle. Charges a
/// triangle for each face to LoadBudget.
/// @throws std::runtime_error "mesh FILE:LINE: what; remedy": not readable, text in UTF-16, a
/// vertex that is not finite, a face with a vertex that does not exist, an end within an element,
/// too many faces.
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& file);

/// Cuts a polygon into count - 2 triangles with the same winding. A non-convex polygon is cut along
/// inner diagonals; one that crosses itself, in any way. `corners` index `vertices`; no triangles
/// for fewer than three corners. For a non-convex polygon with more than 64 corners the cost is
/// quadratic, and is charged to LoadBudget.
/// @throws LoadLimitError
void cut_polygon(std::span<const Eigen::Vector3d> vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace reckon::haptics
