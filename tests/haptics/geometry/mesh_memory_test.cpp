// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Memory of a large mesh, in octets a triangle: while its file is loaded, and afterwards.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics {
namespace {

// 5 million triangles then take 700 MB.
constexpr double kMostOctets = 140.0;

struct Octets {
  double at_peak, at_end;  // of the heap, for each triangle
};

Octets octets_of(const test::TemporaryMesh& file) {
  const test::AllocationGuard guard;
  const SurfaceMesh mesh = SurfaceMesh::load({file.path(), 0.0, false});
  const auto triangles = static_cast<double>(mesh.triangles().size());
  const auto peak = static_cast<double>(guard.peak_octets());
  const test::AllocationGuard after;
  const SurfaceMesh copy = mesh;
  return {peak / triangles, static_cast<double>(after.peak_octets()) / triangles};
}

TEST(MeshMemory, LoadingAFileTakesFewOctetsATriangle) {
  const test::MeshData torus = test::torus(316, 158);
  const std::pair<const char*, std::string> files[] = {{".stl", test::stl_octets(torus)},
                                                       {".obj", test::obj_text(torus)}};
  for (const auto& [ending, text] : files) {
    const Octets octets = octets_of(test::TemporaryMesh(ending, text));
    EXPECT_LT(octets.at_peak, kMostOctets) << ending;
    EXPECT_LT(octets.at_end, kMostOctets) << ending;
  }
}

}  // namespace
}  // namespace reckon::haptics
