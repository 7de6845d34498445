// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Closest point of a torus of 69,696 triangles, compared with Embree, in alternation on the same
// points: anywhere near the surface, along a stroke, and along a stroke with state from tick to
// tick: the last tick's triangle as the first bound of both, and in ours also the triangles around
// it. The time of a row is the sum of both. The counters separate them, as medians over pairs of
// rounds, and have the greatest difference of the two distances.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "reckon/bench/micro/embree_mesh.hpp"
#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using reckon::bench::EmbreeMesh;
using reckon::haptics::ClosestPoint;
using reckon::haptics::NearTriangles;
using reckon::haptics::SurfaceMesh;
namespace test = reckon::test;

constexpr double kSize = 0.2;
constexpr double kDepth = 2e-3;
constexpr std::size_t kPoints = 4096;

const SurfaceMesh& torus() {
  static const SurfaceMesh mesh = test::make_mesh(test::torus(264, 132), kSize);
  return mesh;
}

std::vector<Vector3d> near_points() {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> pick(0, torus().triangles().size() - 1);
  std::uniform_real_distribution<double> away(-kDepth, kDepth);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const auto& t = torus().triangles()[pick(random)];
    points.emplace_back((t.a + t.b + t.c) / 3.0 + away(random) * t.normal);
  }
  return points;
}

// At 0.1 m/s, 2 mm below the surface, at 1 kHz.
std::vector<Vector3d> stroke_points() {
  test::Stroke stroke(torus(), 1e-4, kDepth, 7);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < kPoints; ++i) points.push_back(stroke.next());
  return points;
}

struct Ours {
  const SurfaceMesh& mesh;
  bool warm;
  ClosestPoint nearest{};
  NearTriangles near{};

  double ask(const Vector3d& p) {
    if (warm) {
      mesh.closest_near(p, near, nearest);
    } else {
      benchmark::DoNotOptimize(mesh.closest(p, 1.0, nearest));
    }
    return nearest.distance;
  }
};

struct Theirs {
  const EmbreeMesh& mesh;
  bool warm;
  EmbreeMesh::Nearest nearest{};

  double ask(const Vector3f& p) {
    nearest = warm ? mesh.closest_from(p, nearest.triangle) : mesh.closest(p);
    return nearest.distance;
  }
};

// Nanoseconds of processor time for each point, which other programs affect least.
template <class Asked, class Point>
double round_of(Asked& asked, const std::vector<Point>& points) {
  const std::clock_t before = std::clock();
  for (const Point& p : points) benchmark::DoNotOptimize(asked.ask(p));
  return 1e9 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - before) /
         static_cast<double>(points.size());
}

void closest_beside_embree(benchmark::State& state, const std::vector<Vector3d>& points,
                           bool warm) {
  const EmbreeMesh embree(torus());
  std::vector<Vector3f> rounded;
  for (const Vector3d& p : points) rounded.push_back(p.cast<float>());
  Ours ours{torus(), warm};
  Theirs theirs{embree, warm};
  double difference = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    difference = std::max(difference, std::abs(ours.ask(points[i]) - theirs.ask(rounded[i])));
  }
  if (difference > 1e-7) state.SkipWithError("the two differ by more than single precision");

  std::vector<double> ours_ns, theirs_ns, ratios;
  for (auto _ : state) {
    ours_ns.push_back(round_of(ours, points));
    theirs_ns.push_back(round_of(theirs, rounded));
    ratios.push_back(theirs_ns.back() / ours_ns.back());
  }
  state.counters["ours_ns"] = reckon::bench::quantile(ours_ns, 0.5);
  state.counters["embree_ns"] = reckon::bench::quantile(theirs_ns, 0.5);
  state.counters["ratio"] = reckon::bench::quantile(ratios, 0.5);
  state.counters["ratio_p10"] = reckon::bench::quantile(ratios, 0.1);
  state.counters["ratio_p90"] = reckon::bench::quantile(ratios, 0.9);
  state.counters["difference_m"] = difference;
}

BENCHMARK_CAPTURE(closest_beside_embree, within_2_mm, near_points(), false);
BENCHMARK_CAPTURE(closest_beside_embree, stroke_cold, stroke_points(), false);
BENCHMARK_CAPTURE(closest_beside_embree, stroke_warm, stroke_points(), true);

}  // namespace
