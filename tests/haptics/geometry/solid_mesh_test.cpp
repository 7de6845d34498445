// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The triangles of a solid against its formulas and its own function.
#include "reckon/haptics/geometry/solid_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reckon/haptics/geometry/solid_moments.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

// Distance of its corners, and of the middles of its triangles, from the surface [m].
struct Off {
  double corners = 0.0, middles = 0.0;
};

Off off_of(const SurfaceMesh& mesh, const ImplicitSolid& solid) {
  Off out;
  for (const Triangle& t : mesh.triangles()) {
    for (const Vector3d* p : {&t.a, &t.b, &t.c})
      out.corners = std::max(out.corners, std::abs(solid.sample(*p).value));
    const Vector3d middle = (t.a + t.b + t.c) / 3.0;
    out.middles = std::max(out.middles, std::abs(solid.sample(middle).value));
  }
  return out;
}

void expect_solid(const ImplicitSolid& solid, double volume, double curvature, double share) {
  const SurfaceMesh mesh = mesh_of(solid, 32);
  EXPECT_TRUE(mesh.report().closed) << solid.what();
  EXPECT_EQ(mesh.report().pieces, 1U) << solid.what();
  EXPECT_NEAR(mesh.report().volume, volume, share * volume) << solid.what();
  const double edge = solid.bounds().sizes().maxCoeff() / 32;
  const Off off = off_of(mesh, solid);
  EXPECT_LT(off.corners, 1e-3 * edge) << solid.what();
  EXPECT_LT(off.middles, 0.5 * edge * edge * curvature + 1e-9) << solid.what();
}

TEST(SolidMesh, IsClosedAndHasItsFormulasVolume) {
  expect_solid(ImplicitSolid(CylinderShape{0.03, 0.08}), kPi * 0.03 * 0.03 * 0.08, 1 / 0.03, 0.004);
  expect_solid(ImplicitSolid(TorusShape{0.04, 0.01}), 2 * kPi * kPi * 0.04 * 1e-4, 1 / 0.01, 0.02);
  expect_solid(ImplicitSolid(EllipsoidShape{{0.03, 0.03, 0.03}}), 4 * kPi / 3 * 2.7e-5, 1 / 0.03,
               0.004);
  expect_solid(ImplicitSolid(ConeShape{0.03, 0.02, 0.05}), kPi * 0.05 / 3 * (9e-4 + 6e-4 + 4e-4),
               1 / 0.02, 0.004);
}

// A block with a bore: its edges are sharp for any grid, so its moments are exact except for the
// bore.
TEST(SolidMesh, KeepsEdgesSharp) {
  CsgShape shape;
  CsgPart block;
  block.shape = BoxShape{{0.1, 0.06, 0.04}};
  CsgPart corner;
  corner.operation = CsgOperation::subtract;
  corner.shape = BoxShape{{0.05, 0.03, 0.1}};
  corner.position = {0.04, 0.025, 0.0};
  shape.parts = {block, corner};
  const ImplicitSolid solid(shape);
  const double taken = 0.035 * 0.02 * 0.04;
  for (const int cells : {13, 20, 32}) {
    const SurfaceMesh mesh = mesh_of(solid, cells);
    EXPECT_NEAR(mesh.report().volume, 0.1 * 0.06 * 0.04 - taken, 1e-4 * taken) << cells;
    EXPECT_LT((mesh.bounds().sizes() - Vector3d(0.1, 0.06, 0.04)).norm(), 1e-8) << cells;
  }
}

TEST(SolidMesh, RefusesSolidsThatItCannotTriangulate) {
  CsgShape plate;
  CsgPart part;
  part.shape = BoxShape{{0.5, 0.5, 0.0005}};
  plate.parts = {part};
  EXPECT_THROW(static_cast<void>(mesh_of(ImplicitSolid(plate), 4)), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics
