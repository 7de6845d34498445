// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and quality of implicit surfaces of about 0.1 m: f and its gradient near the surface, a
// sweep of 3 mm, and a tick of the contact point for a hand that strokes 2 mm below the surface at
// 0.1 m/s. A tick's row also has its error: f at the contact point, and lag, the distance to the
// settled position if the device waits.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/implicit_solids.hpp"

namespace {

using Eigen::Vector3d;
using reckon::haptics::ContactShape;
using reckon::haptics::FrictionCone;
using reckon::haptics::ImplicitSolid;
using reckon::haptics::SurfaceContactPoint;
using reckon::haptics::SweepHit;
namespace test = reckon::test;

constexpr double kDepth = 2e-3;
constexpr double kStep = 1e-4;  // [m] for each tick

Vector3d random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> x(-reach, reach);
  return {x(random), x(random), x(random)};
}

const std::vector<test::NamedSolid>& solids() {
  static const std::vector<test::NamedSolid> all = test::implicit_solids();
  return all;
}

// Points within 2 mm of the surface.
std::vector<Vector3d> near_points(const ImplicitSolid& solid) {
  std::mt19937 random(5);
  std::vector<Vector3d> points;
  while (points.size() < 2048) {
    const Vector3d p = random_point(random, 0.09);
    if (std::abs(solid.sample(p).value) < kDepth) points.push_back(p);
  }
  return points;
}

void value_and_gradient(benchmark::State& state, std::size_t subject) {
  const ImplicitSolid& solid = *solids()[subject].solid;
  const std::vector<Vector3d> points = near_points(solid);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solid.sample(points[i]));
    if (++i == points.size()) i = 0;
  }
}

void sweep_3_mm(benchmark::State& state, std::size_t subject) {
  const ImplicitSolid& solid = *solids()[subject].solid;
  std::mt19937 random(6);
  std::vector<Vector3d> points = near_points(solid);
  std::erase_if(points, [&](const Vector3d& p) { return solid.contains(p, solid.clearance()); });
  std::vector<Vector3d> steps;
  for (std::size_t i = 0; i < points.size(); ++i)
    steps.push_back(3e-3 * random_point(random, 1.0).normalized());
  std::size_t i = 0;
  double hits = 0.0;
  for (auto _ : state) {
    SweepHit hit;
    hits += solid.sweep(points[i], steps[i], 0.0, hit) ? 1.0 : 0.0;
    if (++i == points.size()) i = 0;
  }
  state.counters["hit_share"] = hits / static_cast<double>(state.iterations());
}

// A stroke that moves over the surface, always 2 mm below the contact point.
class Stroke {
 public:
  explicit Stroke(std::size_t subject)
      : solid_(*solids()[subject].solid), shape_(solids()[subject].solid) {
    begin();
  }

  Vector3d next() {
    if (!point_.in_contact()) begin();
    const Vector3d normal = solid_.sample(point_.scp()).gradient.normalized();
    way_ += random_point(random_, 0.1);
    way_ = (way_ - way_.dot(normal) * normal).normalized();
    return point_.scp() + kStep * way_ - kDepth * normal;
  }

  SurfaceContactPoint& point() { return point_; }
  const ContactShape& shape() const { return shape_; }
  const ImplicitSolid& solid() const { return solid_; }

 private:
  // Moves from outside down to a point of the surface.
  void begin() {
    SweepHit hit;
    Vector3d from;
    Vector3d way;
    do {
      from = 0.2 * random_point(random_, 1.0).normalized();
      way = random_point(random_, 0.05) - from;
    } while (solid_.contains(from, 1e-3) || !solid_.sweep(from, way, 0.0, hit));
    point_.reset(shape_, from);
    point_.update(shape_, from + hit.t * way - 1e-4 * hit.normal, nullptr);
  }

  const ImplicitSolid& solid_;
  ContactShape shape_;
  SurfaceContactPoint point_;
  std::mt19937 random_{3};
  Vector3d way_ = Vector3d::UnitX();
};

void contact_tick(benchmark::State& state, std::size_t subject, bool rough) {
  Stroke stroke(subject);
  FrictionCone friction(0.01, 0.005);
  FrictionCone* used = rough ? &friction : nullptr;
  std::vector<double> times;
  double worst = 0.0;
  double lag = 0.0;
  for (auto _ : state) {
    const Vector3d device = stroke.next();
    times.push_back(
        reckon::bench::cpu_ns_of([&] { stroke.point().update(stroke.shape(), device, used); }));
    state.SetIterationTime(1e-9 * times.back());
    if (!stroke.point().in_contact()) continue;
    const double f = std::abs(stroke.solid().sample(stroke.point().scp()).value);
    worst = std::max(worst, f);
    SurfaceContactPoint again = stroke.point();
    again.update(stroke.shape(), device, used);
    lag = std::max(lag, (again.scp() - stroke.point().scp()).norm());
  }
  if (worst > 1e-9) state.SkipWithError("the contact point left the surface");
  state.counters["median_ns"] = reckon::bench::median(times);
  state.counters["p99_ns"] = reckon::bench::quantile(times, 0.99);
  state.counters["f_max_nm"] = 1e9 * worst;
  state.counters["lag_max_um"] = 1e6 * lag;
}

const bool registered = [] {
  for (std::size_t s = 0; s < solids().size(); ++s) {
    const std::string& name = solids()[s].name;
    benchmark::RegisterBenchmark(("value_and_gradient/" + name).c_str(), value_and_gradient, s);
    benchmark::RegisterBenchmark(("sweep_3_mm/" + name).c_str(), sweep_3_mm, s);
    for (const bool rough : {false, true}) {
      const std::string row = "contact_tick/" + name + (rough ? "/friction" : "/smooth");
      benchmark::RegisterBenchmark(row.c_str(), contact_tick, s, rough)->UseManualTime();
    }
  }
  return true;
}();

}  // namespace
