// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/surface_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

MeshShape shape_of(const test::TemporaryMesh& file) { return {file.path(), 0.0, false}; }

std::string off(const test::MeshData& mesh) {
  std::ostringstream out;
  out << "OFF\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
  for (const Vector3d& v : mesh.vertices) out << v.transpose() << "\n";
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return out.str();
}

std::string ply(const test::MeshData& mesh) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3d& v : mesh.vertices) out << v.transpose() << "\n";
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return out.str();
}

std::string stl(const test::MeshData& mesh) {
  std::ostringstream out;
  out << "solid s\n";
  for (const auto& t : mesh.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : t)
      out << "vertex " << mesh.vertices[corner].transpose() << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid s\n";
  return out.str();
}

TEST(SurfaceMesh, ReadsEveryFormatAsTheSameClosedSurface) {
  const test::MeshData cube = test::cube();
  const std::pair<std::string, std::string> files[] = {{".obj", test::obj_text(cube)},
                                                       {".off", off(cube)},
                                                       {".ply", ply(cube)},
                                                       {".stl", stl(cube)}};
  for (const auto& [extension, text] : files) {
    SCOPED_TRACE(extension);
    const test::TemporaryMesh file(extension, text);
    const SurfaceMesh mesh = SurfaceMesh::load(shape_of(file));
    EXPECT_EQ(mesh.report().vertices, 8u);
    EXPECT_EQ(mesh.report().triangles, 12u);
    EXPECT_TRUE(mesh.report().closed);
    EXPECT_EQ(mesh.report().inconsistent_edges.count, 0u);
    EXPECT_NEAR(mesh.report().volume, 1.0, 1e-12);
  }
}

TEST(SurfaceMesh, ScalesToADiagonalAndCentres) {
  const test::TemporaryMesh file(".obj", test::obj_text(test::torus(20, 10)));
  MeshShape shape = shape_of(file);
  shape.scale_to = 0.2;
  shape.centre = true;
  const SurfaceMesh mesh = SurfaceMesh::load(shape);
  EXPECT_NEAR(mesh.size(), 0.2, 1e-12);
  EXPECT_LT(mesh.bounds().center().norm(), 1e-12);
}

TEST(SurfaceMesh, TurnsAnInwardClosedSurface) {
  test::MeshData cube = test::cube();
  for (auto& t : cube.triangles) std::swap(t[0], t[1]);
  const SurfaceMesh mesh(cube.vertices, cube.triangles);
  EXPECT_EQ(mesh.report().inward_pieces, 1u);
  EXPECT_NEAR(mesh.report().volume, 1.0, 1e-12);
  EXPECT_NEAR(test::winding_number(mesh, Vector3d(0.5, 0.4, 0.3)), 1.0, 1e-9);
}

TEST(SurfaceMesh, DropsDegenerateTrianglesAndCountsThem) {
  test::MeshData cube = test::cube();
  cube.triangles.push_back({0, 0, 1});
  cube.triangles.push_back({0, 1, 1});
  cube.vertices.emplace_back(0.5, 0.0, 0.0);  // on the edge from 0 to 1
  cube.triangles.push_back({0, 8, 1});
  const SurfaceMesh mesh(cube.vertices, cube.triangles);
  EXPECT_EQ(mesh.report().dropped_degenerate.count, 3u);
  EXPECT_EQ(mesh.report().triangles, 12u);
}

TEST(SurfaceMesh, TakesAnOpenSurfaceAsAShell) {
  test::MeshData cube = test::cube();
  cube.triangles.resize(10);
  const SurfaceMesh mesh(cube.vertices, cube.triangles);
  EXPECT_FALSE(mesh.report().closed);
  EXPECT_GT(mesh.report().boundary_edges.count, 0u);
  EXPECT_FALSE(mesh.contains({0.5, 0.5, 0.5}));
}

TEST(SurfaceMesh, ReadsANonManifoldFileCompletely) {
  // Three triangles on one edge: a half-edge structure would have to omit one.
  const test::TemporaryMesh file(
      ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  const SurfaceMesh mesh = SurfaceMesh::load(shape_of(file));
  EXPECT_EQ(mesh.report().triangles, 3u);
  EXPECT_EQ(mesh.report().non_manifold_edges.count, 1u);
  EXPECT_FALSE(mesh.report().closed);
}

TEST(SurfaceMesh, InsideTestAgreesWithTheWindingNumber) {
  for (const test::MeshData& data :
       {test::torus(30, 15), test::groove(), test::fin(0.05), test::cube()}) {
    const SurfaceMesh mesh = test::make_mesh(data, 0.2);
    ASSERT_TRUE(mesh.report().closed);
    ASSERT_EQ(mesh.report().inconsistent_edges.count, 0u);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = mesh.bounds().min() + mesh.bounds().sizes().cwiseProduct(Vector3d(
                                                   share(random), share(random), share(random)));
      ASSERT_EQ(mesh.contains(p), test::winding_number(mesh, p) > 0.5);
    }
  }
}

TEST(SurfaceMesh, NamesAFilesFaultAndRemedy) {
  const auto message = [](const MeshShape& shape) {
    try {
      (void)SurfaceMesh::load(shape);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message({"no/such.obj", 0.0, false}), testing::HasSubstr("no such file"));
  EXPECT_THAT(message(shape_of(test::TemporaryMesh(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"))),
              testing::HasSubstr("no triangle"));
  EXPECT_THAT(message(shape_of(test::TemporaryMesh(".ply", "not a mesh"))),
              testing::HasSubstr("cannot be read"));
  const test::TemporaryMesh cube(".obj", test::obj_text(test::cube()));
  EXPECT_THAT(message({cube.path(), -1.0, false}), testing::HasSubstr("scale_to"));
}

}  // namespace
}  // namespace reckon::haptics
