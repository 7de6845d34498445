// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reading of mesh files by OpenMesh.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using FileMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

std::runtime_error mesh_error(const MeshShape& shape, const std::string& what) {
  return std::runtime_error("mesh " + shape.file.string() + ": " + what);
}

FileMesh read(const MeshShape& shape) {
  if (!std::filesystem::is_regular_file(shape.file)) {
    throw mesh_error(shape, "no such file; give the path relative to the scene file");
  }
  omerr().disable();  // it prints each face that it has to split
  FileMesh mesh;
  const bool read_well = OpenMesh::IO::read_mesh(mesh, shape.file.string());
  omerr().enable();
  if (!read_well) throw mesh_error(shape, "cannot be read; give a valid OBJ, PLY, STL or OFF file");
  return mesh;
}

void place(const MeshShape& shape, std::vector<Vector3d>& vertices) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& v : vertices) box.extend(v);
  if (!std::isfinite(shape.scale_to) || shape.scale_to < 0.0) {
    throw mesh_error(shape, "scale_to must be a length > 0, or 0 to keep the file's metres");
  }
  const double size = box.isEmpty() ? 0.0 : box.sizes().norm();
  const double factor = shape.scale_to > 0.0 && size > 0.0 ? shape.scale_to / size : 1.0;
  const Vector3d origin = shape.centre && size > 0.0 ? Vector3d(box.center()) : Vector3d::Zero();
  for (Vector3d& v : vertices) v = (v - origin) * factor;
}

}  // namespace

SurfaceMesh SurfaceMesh::load(const MeshShape& shape) {
  const FileMesh file = read(shape);
  std::vector<Vector3d> vertices;
  vertices.reserve(file.n_vertices());
  for (const auto vertex : file.vertices()) {
    const FileMesh::Point& p = file.point(vertex);
    vertices.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(file.n_faces());
  for (const auto face : file.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t corner = 0;
    for (const auto vertex : file.fv_range(face)) {
      if (corner < 3) triangle[corner++] = static_cast<std::uint32_t>(vertex.idx());
    }
    triangles.push_back(triangle);
  }
  place(shape, vertices);
  try {
    return SurfaceMesh(std::move(vertices), std::move(triangles));
  } catch (const std::runtime_error& error) {
    throw mesh_error(shape, error.what());
  }
}

}  // namespace reckon::haptics
