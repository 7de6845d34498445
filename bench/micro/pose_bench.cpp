// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a pose against a plain implementation, in alternation within one run: a query of RVB, and
// the same smoothed. The error is in the same row as the time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "reckon/bench/micro/blocks.hpp"
#include "reckon/bench/micro/rvb_rivals.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::bench {
namespace {

using deadreckon::ConvergenceCurve;
using deadreckon::extrapolate;
using deadreckon::kConvergenceCurves;
using deadreckon::PoseConvergence;

constexpr double kBlend = 0.1;  // [s] of smoothing

// Greatest error of 16 entities [m].
template <typename Query>
double error_of(const States& all, Query&& query) {
  double worst = 0;
  for (std::size_t i = 0; i < 16; ++i)
    worst = std::max(worst,
                     (query(all[i], kTau).position - Reference(all[i]).position_at(kTau)).norm());
  return worst;
}

// Nanoseconds of one query, over all entities in turn.
template <typename Query>
double time_of(const States& all, Query&& query) {
  std::size_t i = 0;
  return nanoseconds_of([&] {
    Pose pose = query(all[i++ % kStates], kTau);
    benchmark::DoNotOptimize(pose);
  });
}

// range(0): angular velocity [nrad/s].
void query_against_plain(benchmark::State& bench) {
  const States all = states(Algorithm::rvb, 1e-9 * static_cast<double>(bench.range(0)));
  const auto reckon = [](const KinematicState& s, double t) { return extrapolate(s, t); };
  bench.counters["error_m"] = error_of(all, reckon);
  bench.counters["plain_error_m"] = error_of(all, textbook_rvb);
  bench.counters["straight_error_m"] = error_of(all, straight_rvb);
  if (error_of(all, reckon) > 1e-6) bench.SkipWithError("off by more than a micrometre");
  Blocks plain, straight, own, ratio;
  for (auto _ : bench) {
    const double plain_ns = time_of(all, textbook_rvb);
    const double own_ns = time_of(all, reckon);
    straight.add(time_of(all, straight_rvb));
    plain.add(plain_ns);
    own.add(own_ns);
    ratio.add(own_ns / plain_ns);
  }
  plain.report(bench, "plain_ns");
  straight.report(bench, "straight_ns");
  own.report(bench, "query_ns");
  ratio.report(bench, "ratio");
}
BENCHMARK(query_against_plain)
    ->Name("query")
    ->ArgName("nanorad_per_s")
    ->Arg(0)
    ->Arg(1)
    ->Arg(400'000'000)
    ->Arg(5'000'000'000);

// An update: the state shown before it, and its own state.
struct Correction {
  KinematicState before, after;
};

Correction correction() {
  Correction c;
  c.after = states(Algorithm::rvb, 0.4)[0];
  c.before = c.after;
  c.before.position += Vector3d(0.1, 0.2, -0.1);
  c.before.velocity += Vector3d(1, 0, 0);
  c.before.orientation = c.after.orientation * exponential({0.02, 0, 0.05});
  return c;
}

// Plain method: both predictions, and a straight line and an arc from one to the other.
Pose blended(const Correction& c, double t) {
  const Pose from = textbook_rvb(c.before, t), to = textbook_rvb(c.after, t);
  const double u = std::min(t / kBlend, 1.0);
  return {from.position + u * (to.position - from.position),
          from.orientation.slerp(u, to.orientation),
          from.velocity + u * (to.velocity - from.velocity),
          from.angular_velocity + u * (to.angular_velocity - from.angular_velocity)};
}

// Greatest difference of the drawn velocities just before and just after the update [m/s].
template <typename Shown>
double velocity_step(const Correction& c, Shown&& shown) {
  constexpr double h = 1e-6;
  const Vector3d old_rate =
      (extrapolate(c.before, 0).position - extrapolate(c.before, -h).position) / h;
  return ((shown(h).position - shown(0.0).position) / h - old_rate).norm();
}

// range(0): the row of kConvergenceCurves. The prediction alone and the plain blend alternate.
void smoothed_against_plain(benchmark::State& bench) {
  const auto& row = kConvergenceCurves[static_cast<std::size_t>(bench.range(0))];
  const Correction c = correction();
  deadreckon::ConvergenceSettings settings;
  settings.curve = row.curve;
  settings.duration = settings.longest = kBlend;
  PoseConvergence convergence(settings);
  convergence.restart(extrapolate(c.before, 0), extrapolate(c.after, 0), 0);
  const auto shown = [&](double t) { return convergence.shown(extrapolate(c.after, t), t); };
  const auto plain_shown = [&](double t) { return blended(c, t); };
  const auto time = [](auto&& query) {
    double t = 0;
    return nanoseconds_of([&] {
      t += 1e-4 / 500;
      Pose pose = query(t);
      benchmark::DoNotOptimize(pose);
    });
  };
  Blocks query, plain, own, ratio, plain_ratio;
  for (auto _ : bench) {
    const double query_ns = time([&](double t) { return extrapolate(c.after, t); });
    const double own_ns = time(shown);
    const double plain_ns = time(plain_shown);
    query.add(query_ns);
    own.add(own_ns);
    plain.add(plain_ns);
    ratio.add(own_ns / query_ns);
    plain_ratio.add(own_ns / plain_ns);
  }
  bench.SetLabel(std::string(row.name));
  query.report(bench, "query_ns");
  own.report(bench, "smoothed_ns");
  plain.report(bench, "plain_ns");
  ratio.report(bench, "ratio");
  plain_ratio.report(bench, "plain_ratio");
  bench.counters["step_m"] = (shown(0).position - extrapolate(c.before, 0).position).norm();
  bench.counters["step_m_per_s"] = velocity_step(c, shown);
  bench.counters["plain_step_m_per_s"] = velocity_step(c, plain_shown);
}
BENCHMARK(smoothed_against_plain)
    ->Name("smoothed")
    ->DenseRange(0, static_cast<int>(kConvergenceCurves.size()) - 1);

}  // namespace
}  // namespace reckon::bench
