// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Repairs of the mesh reader and defects that it keeps, on surfaces with known counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::MeshData;

const Vector3d kNational(4321012.3456, 678901.2345, 432.1);  // [m]

/// A torus of radii 1 and 0.4 with u by v quads: each ring of the outline is an exact polygon,
/// revolved as a polygon again. By Pappus for polygons: the sum of the frustum volumes over the
/// outline's edges.
double torus_volume(int nu, int nv) {
  const double round = 0.5 * nu * std::sin(2.0 * std::numbers::pi / nu);  // area of a u-gon, r = 1
  double volume = 0.0;
  for (int j = 0; j < nv; ++j) {
    const double v = 2.0 * std::numbers::pi * j / nv, w = 2.0 * std::numbers::pi * (j + 1) / nv;
    const double r = 1.0 + 0.4 * std::cos(v), s = 1.0 + 0.4 * std::cos(w);
    volume += round * (r * r + r * s + s * s) / 3.0 * 0.4 * (std::sin(w) - std::sin(v));
  }
  return std::abs(volume);
}

void add(MeshData& to, MeshData more, const Vector3d& offset, double scale = 1.0) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (const Vector3d& v : more.vertices) to.vertices.push_back(scale * v + offset);
  for (auto& t : more.triangles) {
    for (std::uint32_t& corner : t) corner += first;
    to.triangles.push_back(t);
  }
}

MeshData inverted(MeshData mesh) {
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  return mesh;
}

SurfaceMesh mesh_of(const MeshData& data) { return {data.vertices, data.triangles}; }

// A figure of which single precision leaves only 96 of 576 triangles.
TEST(MeshRepair, KeepsEveryTriangleOfAGeoreferencedFile) {
  MeshData torus = test::torus(24, 12);
  for (Vector3d& v : torus.vertices) v *= 0.04;
  const test::TemporaryMesh file(".obj", test::obj_text(torus, kNational));
  for (const bool centre : {false, true}) {
    const SurfaceMesh mesh = SurfaceMesh::load({file.path(), 0.0, centre});
    const MeshReport& report = mesh.report();
    EXPECT_EQ(report.triangles, 576u);
    EXPECT_EQ(report.vertices, 288u);
    EXPECT_EQ(report.dropped_degenerate.count, 0u);
    EXPECT_EQ(report.merged_vertices, 0u);
    EXPECT_TRUE(report.closed);
    // Coordinates are rounded to 1 nm in the file and to 0.5 nm at 4321 km.
    const double exact = torus_volume(24, 12) * 0.04 * 0.04 * 0.04;
    EXPECT_NEAR(report.volume, exact, 1e-6 * exact);
    EXPECT_LT(mesh.bounds().center().norm(), 1e-9) << "kept relative to its middle";
    EXPECT_LT((mesh.origin() - (centre ? Vector3d::Zero() : kNational)).norm(), 2e-9);
  }
}

TEST(MeshRepair, LeavesAMeshNearItsOriginInPlace) {
  MeshData cube = test::cube();
  for (Vector3d& v : cube.vertices) v += Vector3d(30, 0, 0);
  const test::TemporaryMesh file(".obj", test::obj_text(cube));
  const SurfaceMesh mesh = SurfaceMesh::load({file.path(), 0.0, false});
  EXPECT_EQ(mesh.origin(), Vector3d::Zero());
  EXPECT_EQ(mesh.bounds().min(), Vector3d(30, 0, 0));
}

TEST(MeshRepair, TurnsAHalfInvertedClosedMeshOutwards) {
  MeshData torus = test::torus(24, 12);
  std::mt19937 random(5);
  std::size_t against = 0;
  for (auto& t : torus.triangles) {
    if (random() % 2 == 0) continue;
    std::swap(t[1], t[2]);
    ++against;
  }
  const SurfaceMesh mesh = mesh_of(torus);
  EXPECT_TRUE(mesh.report().closed);
  EXPECT_GT(mesh.report().inconsistent_edges.count, 200u);
  EXPECT_EQ(mesh.report().turned.count, against);
  EXPECT_EQ(mesh.report().one_sided_edges, 0u);
  EXPECT_NEAR(mesh.report().volume, torus_volume(24, 12), 1e-12);
  EXPECT_NEAR(test::winding_number(mesh, Vector3d(1, 0.01, 0.02)), 1.0, 1e-9);
}

TEST(MeshRepair, TurnsTheSmallerPartOfAnOpenSurface) {
  MeshData cube = test::cube();
  cube.triangles.pop_back();
  std::swap(cube.triangles[4][0], cube.triangles[4][1]);
  const SurfaceMesh mesh = mesh_of(cube);
  EXPECT_EQ(mesh.report().turned.count, 1u);
  EXPECT_EQ(mesh.report().turned.first, 5u);
  EXPECT_EQ(mesh.report().boundary_edges.count, 3u);
  EXPECT_EQ(mesh.report().holes, 1u);
}

TEST(MeshRepair, TurnsOnePieceAndKeepsACavity) {
  MeshData apart = test::cube();
  add(apart, inverted(test::cube()), Vector3d(3, 0, 0));
  const SurfaceMesh two = mesh_of(apart);
  EXPECT_EQ(two.report().pieces, 2u);
  EXPECT_EQ(two.report().inward_pieces, 1u);
  EXPECT_NEAR(two.report().volume, 2.0, 1e-12);

  MeshData hollow = test::cube();
  add(hollow, inverted(test::cube()), Vector3d::Constant(0.25), 0.5);
  for (const bool inside_out : {false, true}) {
    const SurfaceMesh mesh = mesh_of(inside_out ? inverted(hollow) : hollow);
    EXPECT_EQ(mesh.report().inward_pieces, inside_out ? 2u : 0u);
    EXPECT_NEAR(mesh.report().volume, 1.0 - 0.125, 1e-12);
    EXPECT_NEAR(test::winding_number(mesh, Vector3d(0.5, 0.5, 0.5)), 0.0, 1e-9);
    EXPECT_NEAR(test::winding_number(mesh, Vector3d(0.1, 0.1, 0.1)), 1.0, 1e-9);
  }
}

TEST(MeshRepair, DropsDuplicateTrianglesInEitherDirection) {
  MeshData cube = test::cube();
  const auto first = cube.triangles[0], second = cube.triangles[7];
  cube.triangles.push_back({first[1], first[2], first[0]});
  cube.triangles.push_back({second[1], second[0], second[2]});
  const SurfaceMesh mesh = mesh_of(cube);
  EXPECT_EQ(mesh.report().dropped_duplicates.count, 2u);
  EXPECT_EQ(mesh.report().dropped_duplicates.first, 13u);
  EXPECT_EQ(mesh.report().triangles, 12u);
  EXPECT_TRUE(mesh.report().closed);
}

TEST(MeshRepair, CountsPiecesJoinedByAnEdgeOrCorner) {
  MeshData by_edge = test::cube();
  add(by_edge, test::cube(), Vector3d(1, 1, 0));
  const SurfaceMesh edge = mesh_of(by_edge);
  EXPECT_EQ(edge.report().non_manifold_edges.count, 1u);
  EXPECT_EQ(edge.report().non_manifold_vertices.count, 0u);
  EXPECT_FALSE(edge.report().closed);

  MeshData by_corner = test::cube();
  add(by_corner, test::cube(), Vector3d(1, 1, 1));
  const SurfaceMesh corner = mesh_of(by_corner);
  EXPECT_EQ(corner.report().merged_vertices, 1u);
  EXPECT_EQ(corner.report().non_manifold_edges.count, 0u);
  EXPECT_EQ(corner.report().non_manifold_vertices.count, 1u);
  EXPECT_EQ(corner.report().pieces, 2u);
  EXPECT_TRUE(corner.report().closed);
  EXPECT_NEAR(corner.report().volume, 2.0, 1e-12);
}

TEST(MeshRepair, DetectsAOneSidedSurface) {
  // A Moebius strip of n quads: its border is one loop.
  constexpr std::uint32_t n = 20;
  MeshData strip;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1.0 + w * std::cos(u / 2);
      strip.vertices.emplace_back(r * std::cos(u), r * std::sin(u), w * std::sin(u / 2));
    }
    const std::uint32_t a = 2 * i, b = a + 1;
    if (i + 1 < n) strip.quad(a, b, b + 2, a + 2);
    if (i + 1 == n) strip.quad(a, b, 0, 1);
  }
  const SurfaceMesh mesh = mesh_of(strip);
  EXPECT_EQ(mesh.report().triangles, 2 * n);
  EXPECT_GT(mesh.report().one_sided_edges, 0u);
  EXPECT_EQ(mesh.report().boundary_edges.count, 2 * n);
  EXPECT_FALSE(mesh.report().closed);
}

TEST(MeshRepair, CountsHolesAsLoops) {
  MeshData torus = test::torus(24, 12);
  // Two separate quads, and two neighbours that form one hole.
  for (const std::size_t quad : {100u, 40u, 20u, 19u}) {
    const auto at = torus.triangles.begin() + static_cast<std::ptrdiff_t>(2 * quad);
    torus.triangles.erase(at, at + 2);
  }
  const SurfaceMesh mesh = mesh_of(torus);
  EXPECT_EQ(mesh.report().holes, 3u);
  EXPECT_EQ(mesh.report().boundary_edges.count, 4u + 4u + 6u);
}

TEST(MeshRepair, NamesTheFirstFaceOfEachKind) {
  const test::TemporaryMesh file(".obj",
                                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\n"
                                 "f 1 2 2\nf 1 2 5\nf 3 1 2\nf 1 2\n");
  const MeshReport report = SurfaceMesh::load({file.path(), 0.0, false}).report();
  EXPECT_EQ(report.place_word, "line");
  EXPECT_EQ(report.faces, 5u);
  EXPECT_EQ(report.polygons.count, 1u);
  EXPECT_EQ(report.polygons.first, 6u);
  EXPECT_EQ(report.dropped_degenerate.count, 3u);
  EXPECT_EQ(report.dropped_degenerate.first, 7u);
  EXPECT_EQ(report.dropped_duplicates.count, 1u);
  EXPECT_EQ(report.dropped_duplicates.first, 9u);
  EXPECT_EQ(report.triangles, 2u);
}

}  // namespace
}  // namespace reckon::haptics
