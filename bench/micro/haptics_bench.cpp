// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and quality of contact: a hand strokes a 0.2 m object 2 mm below its surface at 1 kHz. Each
// row has the time of a tick and its quality: lag (distance to the settled position if the device
// waits), gap (SCP to surface, minus the probe's radius) and pops (SCP inside by the winding
// number).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace {

using Eigen::Vector3d;
using reckon::haptics::ClosestPoint;
using reckon::haptics::ContactShape;
using reckon::haptics::FrictionCone;
using reckon::haptics::NearTriangles;
using reckon::haptics::SurfaceContactPoint;
using reckon::haptics::SurfaceMesh;
using reckon::haptics::SweepHit;
namespace test = reckon::test;

constexpr double kSize = 0.2;
constexpr double kDepth = 2e-3;
constexpr int kTicks = 4000;

using MeshPointer = std::shared_ptr<const SurfaceMesh>;

struct Subject {
  const char* name;
  std::function<SurfaceMesh()> make;
};

SurfaceMesh touchstone() {
  return SurfaceMesh::load({RECKON_SOURCE_DIR "/scenes/touchstone.obj", kSize, false});
}

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = {
      {"torus_5k", [] { return test::make_mesh(test::torus(72, 36), kSize); }},
      {"torus_70k", [] { return test::make_mesh(test::torus(264, 132), kSize); }},
      {"torus_500k", [] { return test::make_mesh(test::torus(710, 352), kSize); }},
      {"groove", [] { return test::make_mesh(test::groove(), kSize); }},
      {"touchstone", touchstone}};
  return all;
}

// Made at first use and kept, because the rows of one mesh follow each other.
MeshPointer mesh_of(std::size_t subject) {
  static std::vector<MeshPointer> made(subjects().size());
  if (!made[subject])
    made[subject] = std::make_shared<const SurfaceMesh>(subjects()[subject].make());
  return made[subject];
}

/// A stroke forwards and back, so that it can be repeated without a jump.
std::vector<Vector3d> path(const SurfaceMesh& mesh, double speed, Vector3d& start) {
  test::Stroke stroke(mesh, speed * 1e-3, kDepth, 7);
  start = stroke.start();
  std::vector<Vector3d> devices;
  for (int i = 0; i < kTicks / 2; ++i) devices.push_back(stroke.next());
  for (int i = kTicks / 2; i > 0; --i) devices.push_back(devices[static_cast<std::size_t>(i - 1)]);
  return devices;
}

struct Quality {
  double lag_um = 0.0, gap_um = 0.0, median_ns = 0.0, p99_ns = 0.0;
  int pops = 0;
};

Quality examine(const MeshPointer& mesh, const std::vector<Vector3d>& devices,
                SurfaceContactPoint point, FrictionCone* friction, double radius) {
  const ContactShape shape = mesh;
  const std::size_t check_every = 1 + mesh->triangles().size() / 500;
  std::vector<double> times;
  Quality quality;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    times.push_back(reckon::bench::cpu_ns_of([&] { point.update(shape, devices[i], friction); }));
    SurfaceContactPoint again = point;
    again.update(shape, devices[i], friction);
    quality.lag_um = std::max(quality.lag_um, 1e6 * (again.scp() - point.scp()).norm());
    ClosestPoint nearest;
    if (point.in_contact() && mesh->closest(point.scp(), kSize, nearest)) {
      quality.gap_um = std::max(quality.gap_um, 1e6 * (nearest.distance - radius));
    }
    if (i % check_every == 0 && test::winding_number(*mesh, point.scp()) > 0.5) ++quality.pops;
  }
  quality.median_ns = reckon::bench::median(times);
  quality.p99_ns = reckon::bench::quantile(times, 0.99);
  return quality;
}

void contact_tick(benchmark::State& state, std::size_t subject, double speed, bool rough,
                  double radius) {
  const MeshPointer mesh = mesh_of(subject);
  const ContactShape shape = mesh;
  FrictionCone friction(0.5, 0.35);
  FrictionCone* used = rough ? &friction : nullptr;
  Vector3d start;
  const std::vector<Vector3d> devices = path(*mesh, speed, start);
  SurfaceContactPoint point(radius);
  point.reset(shape, start);
  const Quality quality = examine(mesh, devices, point, used, radius);
  if (quality.pops > 0) state.SkipWithError("the contact point passed through the surface");

  std::size_t tick = 0;
  for (auto _ : state) {
    point.update(shape, devices[tick], used);
    benchmark::DoNotOptimize(point);
    if (++tick == devices.size()) tick = 0;
  }
  state.counters["triangles"] = static_cast<double>(mesh->triangles().size());
  state.counters["lag_max_um"] = quality.lag_um;
  state.counters["gap_max_um"] = quality.gap_um;
  state.counters["pops"] = quality.pops;
  state.counters["median_ns"] = quality.median_ns;
  state.counters["p99_ns"] = quality.p99_ns;
}

// Points within 2 mm of the surface, as in queries of a servo.
std::vector<Vector3d> near_points(const SurfaceMesh& mesh) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> pick(0, mesh.triangles().size() - 1);
  std::uniform_real_distribution<double> away(-kDepth, kDepth);
  std::vector<Vector3d> points;
  for (int i = 0; i < 4096; ++i) {
    const auto& t = mesh.triangles()[pick(random)];
    points.emplace_back((t.a + t.b + t.c) / 3.0 + away(random) * t.normal);
  }
  return points;
}

void closest_point(benchmark::State& state, std::size_t subject) {
  const MeshPointer mesh = mesh_of(subject);
  const std::vector<Vector3d> points = near_points(*mesh);
  std::size_t i = 0;
  for (auto _ : state) {
    ClosestPoint nearest;
    benchmark::DoNotOptimize(mesh->closest(points[i], 1.0, nearest));
    if (++i == points.size()) i = 0;
  }
  state.counters["triangles"] = static_cast<double>(mesh->triangles().size());
}

// Along a stroke, as in a servo from tick to tick: without state, from the last tick's triangle,
// and with the triangles around it.
enum class Kept { nothing, triangle, list };

void closest_on_stroke(benchmark::State& state, std::size_t subject, Kept kept) {
  const MeshPointer mesh = mesh_of(subject);
  Vector3d start;
  const std::vector<Vector3d> points = path(*mesh, 0.1, start);
  ClosestPoint nearest;
  NearTriangles near;
  std::size_t i = 0;
  for (auto _ : state) {
    if (kept == Kept::list) {
      mesh->closest_near(points[i], near, nearest);
    } else if (kept == Kept::triangle) {
      mesh->closest_from(points[i], nearest.triangle, nearest);
    } else {
      benchmark::DoNotOptimize(mesh->closest(points[i], 1.0, nearest));
    }
    benchmark::DoNotOptimize(nearest);
    if (++i == points.size()) i = 0;
  }
  state.counters["triangles"] = static_cast<double>(mesh->triangles().size());
}

// Near the surface of a mesh of 1e5 or 1e6 triangles, for a precision in micrometres: time saved,
// and the additional distance of the point found over the nearest.
void closest_by_precision(benchmark::State& state) {
  static const std::array<SurfaceMesh, 2> meshes{test::make_mesh(test::torus(316, 158), kSize),
                                                 test::make_mesh(test::torus(1000, 500), kSize)};
  const SurfaceMesh& mesh = meshes[state.range(0) > 100'000 ? 1 : 0];
  const double precision = 1e-6 * static_cast<double>(state.range(1));
  const std::vector<Vector3d> points = near_points(mesh);
  double worst = 0.0;
  double squares = 0.0;
  ClosestPoint nearest;
  for (const Vector3d& p : points) {
    ClosestPoint found;
    if (!mesh.closest(p, 1.0, nearest) || !mesh.closest(p, 1.0, found, precision)) continue;
    const double error = found.distance - nearest.distance;
    worst = std::max(worst, error);
    squares += error * error;
  }
  if (worst > precision) state.SkipWithError("farther than the precision allows");
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(mesh.closest(points[i], 1.0, nearest, precision));
    if (++i == points.size()) i = 0;
  }
  state.counters["error_max_um"] = 1e6 * worst;
  state.counters["error_rms_um"] = 1e6 * std::sqrt(squares / static_cast<double>(points.size()));
}
BENCHMARK(closest_by_precision)
    ->ArgNames({"triangles", "precision_um"})
    ->ArgsProduct({{100'000, 1'000'000}, {0, 1, 10, 100, 300, 1000}});

void sweep_3_mm(benchmark::State& state, std::size_t subject) {
  const MeshPointer mesh = mesh_of(subject);
  const std::vector<Vector3d> points = near_points(*mesh);
  std::vector<Vector3d> steps;
  std::mt19937 random(6);
  std::normal_distribution<double> gauss;
  for (std::size_t i = 0; i < points.size(); ++i) {
    steps.push_back(3e-3 * Vector3d(gauss(random), gauss(random), gauss(random)).normalized());
  }
  std::size_t i = 0;
  double hits = 0.0;
  for (auto _ : state) {
    SweepHit hit;
    hits += mesh->sweep(points[i], steps[i], 0.0, hit) ? 1.0 : 0.0;
    if (++i == points.size()) i = 0;
  }
  state.counters["hit_share"] = hits / static_cast<double>(state.iterations());
  state.counters["triangles"] = static_cast<double>(mesh->triangles().size());
}

void build(benchmark::State& state, std::size_t subject) {
  for (auto _ : state) {
    const SurfaceMesh mesh = subjects()[subject].make();
    benchmark::DoNotOptimize(&mesh);
  }
}

const bool registered = [] {
  for (std::size_t s = 0; s < subjects().size(); ++s) {
    const std::string name = subjects()[s].name;
    for (const double speed : {0.1, 0.5}) {
      for (const bool rough : {false, true}) {
        for (const double radius : {0.0, 1e-3}) {
          const std::string row = "contact_tick/" + name + (speed < 0.2 ? "/0.1_m_s" : "/0.5_m_s") +
                                  (rough ? "/friction" : "/smooth") +
                                  (radius > 0.0 ? "/1_mm_ball" : "");
          benchmark::RegisterBenchmark(row.c_str(), contact_tick, s, speed, rough, radius);
        }
      }
    }
    benchmark::RegisterBenchmark(("closest_within_2_mm/" + name).c_str(), closest_point, s);
    benchmark::RegisterBenchmark(("closest_on_stroke/" + name + "/cold").c_str(), closest_on_stroke,
                                 s, Kept::nothing);
    benchmark::RegisterBenchmark(("closest_on_stroke/" + name + "/warm").c_str(), closest_on_stroke,
                                 s, Kept::triangle);
    benchmark::RegisterBenchmark(("closest_on_stroke/" + name + "/list").c_str(), closest_on_stroke,
                                 s, Kept::list);
    benchmark::RegisterBenchmark(("sweep_3_mm/" + name).c_str(), sweep_3_mm, s);
    benchmark::RegisterBenchmark(("build/" + name).c_str(), build, s)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
