// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time of a tick of the contact point along the path of contact_path.hpp, to compare it with
// another library on the same path. RECKON_CONTACT_PATH=<folder> writes the mesh and the path of
// 0.1 m/s there. Counters: mean, median and 99th percentile over all ticks of the path [ns].
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <memory>

#include "reckon/bench/micro/contact_path.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"

namespace {

using namespace reckon::haptics;
using reckon::bench::ContactPath;
using reckon::bench::TickTimes;

const ContactPath& path_at(bool fast) {
  static const ContactPath paths[] = {ContactPath(0.1), ContactPath(0.5)};
  return paths[fast ? 1 : 0];
}

void contact_path(benchmark::State& state) {
  const ContactPath& path = path_at(state.range(0) != 0);
  if (const char* folder = std::getenv("RECKON_CONTACT_PATH")) path_at(false).write(folder);
  const ContactShape shape = std::make_shared<const SurfaceMesh>(path.mesh);
  FrictionCone cone(0.5, 0.35);
  FrictionCone* friction = state.range(2) != 0 ? &cone : nullptr;
  SurfaceContactPoint point(1e-3 * static_cast<double>(state.range(1)));
  point.reset(shape, path.start);
  TickTimes times;
  for (auto _ : state) {
    times.round(path, [&](const Eigen::Vector3d& p) { point.update(shape, p, friction); });
  }
  state.counters["mean_ns"] = times.mean();
  state.counters["median_ns"] = times.share_below(0.5);
  state.counters["p99_ns"] = times.share_below(0.99);
  if (!point.in_contact()) state.SkipWithError("the contact point passed through the surface");
}
BENCHMARK(contact_path)
    ->ArgNames({"fast", "radius_mm", "friction"})
    ->ArgsProduct({{0, 1}, {0, 1}, {0, 1}});

}  // namespace
