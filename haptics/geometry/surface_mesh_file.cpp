// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes a SurfaceMesh from a file: a mesh, with polygons cut, scaled and centred, or a solid from a
// picture.
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/haptics/geometry/height_field.hpp"
#include "reckon/haptics/geometry/mesh_repair.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/mesh_files/mesh_file.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// Distance of the mesh's middle from its origin, in sizes, beyond which rounding of the coordinates
// would be felt before the shape.
constexpr double kFarAway = 100.0;

std::runtime_error mesh_error(const MeshShape& shape, const std::string& what) {
  return std::runtime_error("mesh " + shape.file.string() + ": " + what);
}

/// Scales and centres. @return the new origin of the vertices, in the shape's axes [m].
Vector3d place(const MeshShape& shape, std::vector<Vector3d>& vertices) {
  if (!std::isfinite(shape.scale_to) || shape.scale_to < 0.0) {
    throw mesh_error(shape, "scale_to must be a length > 0, or 0 to keep the file's metres");
  }
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : vertices) box.extend(v);
  const double size = box.isEmpty() ? 0.0 : box.sizes().norm();
  if (!(size > 0.0)) return Vector3d::Zero();
  const double factor = shape.scale_to > 0.0 ? shape.scale_to / size : 1.0;
  const bool far = box.center().norm() > kFarAway * size;
  const Vector3d middle = shape.centre || far ? Vector3d(box.center()) : Vector3d::Zero();
  for (Vector3d& v : vertices) v = (v - middle) * factor;
  return shape.centre ? Vector3d::Zero() : Vector3d(middle * factor);
}

/// The triangles of one face.
void cut_face(const MeshShape& shape, const MeshFile& file, const FileFace& face,
              std::vector<std::array<std::uint32_t, 3>>& triangles) {
  triangles.clear();
  try {
    if (face.count > 3) LoadBudget::take(LoadWork::triangles, face.count - 3);
    cut_polygon(file.vertices, file.corners_of(face), triangles);
  } catch (const LoadLimitError& error) {
    throw mesh_error(shape, std::string(file.place_word) + " " + std::to_string(face.place) +
                                ": with the face of " + std::to_string(face.count) +
                                " corners, the scene exceeds a limit: " + error.what());
  }
}

TriangleSoup cut_polygons(const MeshShape& shape, MeshFile file, MeshReport& report) {
  TriangleSoup soup;
  report.place_word = file.place_word;
  report.faces = file.faces.size();
  report.octets_behind = file.octets_behind;
  report.merged_vertices = file.merged_vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  soup.triangles.reserve(file.faces.size());
  for (const FileFace& face : file.faces) {
    if (face.count > 3) report.polygons.add(face.place);
    if (face.count < 3) report.dropped_degenerate.add(face.place);
    cut_face(shape, file, face, triangles);
    for (const auto& corners : triangles)
      soup.triangles.push_back({corners, face.place, {face.material, face.group}});
  }
  soup.names = std::move(file.names);
  soup.vertices = std::move(file.vertices);
  return soup;
}

}  // namespace

SurfaceMesh SurfaceMesh::load(const MeshShape& shape) {
  const LoadBudget budget;
  MeshReport report;
  TriangleSoup soup = cut_polygons(shape, read_mesh_file(shape.file), report);
  const Vector3d origin = place(shape, soup.vertices);
  try {
    SurfaceMesh mesh(std::move(soup), report);
    mesh.origin_ = origin;
    return mesh;
  } catch (const std::runtime_error& error) {
    throw mesh_error(shape, error.what());
  }
}

SurfaceMesh SurfaceMesh::load_heights(const HeightsShape& shape, std::size_t most_pixels) {
  const LoadBudget budget;
  const GreyImage picture = heights_of(shape);
  HeightsShape sized = shape;
  sized.length = length_of(shape, picture);
  TriangleSoup soup = solid_of(sized, thinned(picture, most_pixels));
  MeshReport report;
  report.place_word = "face";
  report.faces = soup.triangles.size();
  return {std::move(soup), std::move(report)};
}

}  // namespace reckon::haptics
