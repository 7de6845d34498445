// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contact on scanned and modelled meshes, from the reference data.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/reference_data.hpp"
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
int stroke_ticks() { return std::getenv("RECKON_SOAK") != nullptr ? 50000 : 2000; }

TEST(MeshData, EveryMeshIsFeltWithoutPopThroughLagOrGap) {
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

}  // namespace
}  // namespace reckon::haptics
