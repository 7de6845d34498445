// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Loading a mesh file: CPU time and greatest heap for each triangle. The mesh is a torus, whose
// triangles are in order or shuffled; a row fails unless all of them arrive and close the surface.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "reckon/haptics/geometry/surface_mesh.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace {

using reckon::haptics::SurfaceMesh;
namespace test = reckon::test;

enum class Order { drawn, shuffled };

test::MeshData torus_of(double triangles, Order order) {
  const auto around = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
  test::MeshData mesh = test::torus(2 * around, around);
  if (order == Order::shuffled) {
    std::mt19937 random(1);
    std::ranges::shuffle(mesh.triangles, random);
  }
  return mesh;
}

void load(benchmark::State& state, const std::string& ending, Order order) {
  const test::MeshData torus = torus_of(static_cast<double>(state.range(0)), order);
  const test::TemporaryMesh file(
      ending, ending == ".stl" ? test::stl_octets(torus) : test::obj_text(torus));
  const std::size_t triangles = torus.triangles.size();
  std::size_t peak = 0;
  for (auto _ : state) {
    const test::AllocationGuard guard;
    const SurfaceMesh mesh = SurfaceMesh::load({file.path(), 0.0, false});
    peak = guard.peak_octets();
    const auto& report = mesh.report();
    if (report.triangles != triangles || report.vertices != triangles / 2 || !report.closed)
      state.SkipWithError("triangles are missing");
  }
  using benchmark::Counter;
  state.counters["octets_a_triangle"] = static_cast<double>(peak) / static_cast<double>(triangles);
  state.counters["cpu_s_a_triangle"] = Counter(
      static_cast<double>(triangles), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void sizes(benchmark::internal::Benchmark* row) {
  row->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(load, stl, ".stl", Order::drawn)->Apply(sizes);
BENCHMARK_CAPTURE(load, stl_shuffled, ".stl", Order::shuffled)->Apply(sizes);
BENCHMARK_CAPTURE(load, obj, ".obj", Order::drawn)->Apply(sizes);

}  // namespace
