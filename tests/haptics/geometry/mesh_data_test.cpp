// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contact on scanned and modelled meshes, from the reference data.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <utility>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

struct StrokeQuality {
  int pops = 0;
  double worst_gap = 0.0;   // [m]
  double worst_lag = 0.0;   // [m]
  double worst_rise = 0.0;  // [m], of |device - scp| in an update
};

// 2 mm below the surface of a mesh of 0.2 m, for `ticks` of 1 ms.
StrokeQuality stroke(const std::shared_ptr<const SurfaceMesh>& mesh, double speed, int ticks,
                     FrictionCone* friction) {
  const ContactShape shape = mesh;
  SurfaceContactPoint point;
  test::Stroke hand(*mesh, speed * 1e-3, 2e-3, 7);
  point.reset(shape, hand.start());
  const int check_every = 1 + static_cast<int>(mesh->triangles().size() / 1000);
  StrokeQuality quality;
  for (int i = 0; i < ticks; ++i) {
    const Vector3d device = hand.next();
    const double before = (device - point.scp()).norm();
    point.update(shape, device, friction);
    quality.worst_rise = std::max(quality.worst_rise, (device - point.scp()).norm() - before);
    if (i % check_every == 0 && test::winding_number(*mesh, point.scp()) > 0.5) ++quality.pops;
    ClosestPoint nearest;
    if (point.in_contact() && mesh->closest(point.scp(), mesh->size(), nearest)) {
      quality.worst_gap = std::max(quality.worst_gap, nearest.distance);
    }
    SurfaceContactPoint again = point;
    again.update(shape, device, friction);
    quality.worst_lag = std::max(quality.worst_lag, (again.scp() - point.scp()).norm());
  }
  return quality;
}

// RECKON_SOAK=1 strokes each mesh longer: 6 meshes x 2 speeds x 2 frictions make 1.2 million ticks.
int stroke_ticks() { return test::tries(700, 50000); }

TEST(MeshData, EveryMeshIsFeltWithoutPopThrough) {
  RECKON_NEED_DATA("meshes");
  int meshes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::reference_data() / "meshes")) {
    if (entry.path().extension() != ".obj") continue;
    ++meshes;
    const auto mesh =
        std::make_shared<const SurfaceMesh>(SurfaceMesh::load({entry.path(), 0.2, true}));
    EXPECT_TRUE(mesh->report().closed) << entry.path();
    EXPECT_EQ(mesh->report().dropped_degenerate.count, 0u) << entry.path();
    for (const double speed : {0.1, 0.5}) {
      for (const bool rough : {false, true}) {
        FrictionCone friction(0.5, 0.35);
        const StrokeQuality quality =
            stroke(mesh, speed, stroke_ticks(), rough ? &friction : nullptr);
        SCOPED_TRACE(testing::Message()
                     << entry.path().filename() << " at " << speed << " m/s, friction " << rough);
        EXPECT_EQ(quality.pops, 0);
        EXPECT_LE(quality.worst_gap, 1e-7);
        EXPECT_LE(quality.worst_lag, 1e-7);
        EXPECT_LE(quality.worst_rise, 0.0);
      }
    }
  }
  EXPECT_GE(meshes, 6);
}

// A plate of 0.2 mm, a plate with inward faces and a sheet of alternating windings, from above to
// 30 mm below and back in 4 s. Limits: 800 N/m times the greatest speed, 47 mm/s, gives 0.038 N in
// 1 ms.
TEST(MeshData, ThinTurnedAndMixedSurfacesPushUpwards) {
  RECKON_NEED_DATA("field/mesh");
  const std::pair<const char*, double> tops[]{
      {"plate02.obj", 1e-4}, {"plate_inverted.obj", 0.01}, {"sheet_mixed.obj", 0}};
  for (const auto& [name, top] : tops) {
    SCOPED_TRACE(name);
    const ContactShape shape = std::make_shared<const SurfaceMesh>(
        SurfaceMesh::load({test::reference_data() / "field/mesh" / name, 0.0, false}));
    SurfaceContactPoint point;
    const auto height = [](int i) { return 0.03 * std::cos(2 * std::numbers::pi * i / 4000); };
    point.reset(shape, {0.001, 0.002, height(0)});
    double greatest = 0, last = 0;
    for (int i = 1; i <= 4000; ++i) {
      const Vector3d device(0.001, 0.002, height(i));
      point.update(shape, device, nullptr);
      const Vector3d force = 800 * (point.scp() - device);
      EXPECT_LT(std::hypot(force.x(), force.y()), 1e-9);
      EXPECT_GE(force.z(), -1e-9);
      EXPECT_LT(std::abs(force.z() - last), 0.05) << i << " ms";
      greatest = std::max(greatest, last = force.z());
    }
    EXPECT_NEAR(greatest, 800 * (0.03 + top), 1e-3);
    EXPECT_NEAR(last, 0, 1e-9);
  }
}

}  // namespace
}  // namespace reckon::haptics
