// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/sampled_spring.hpp"

#include <fmt/format.h>

#include <cmath>

namespace reckon::bench {
namespace {

/// Depth and force at the instants at which the force changes: one point before and one after.
struct Staircase {
  FigureCurve press, release;
};

long samples_each_way(const SampledSpring& s) {
  return std::lround(s.depth / (s.speed * s.sample_period));
}

double depth_at(const SampledSpring& s, long sample) {
  return s.speed * s.sample_period * static_cast<double>(sample);
}

void hold(FigureCurve& curve, double from, double to, double force) {
  curve.x.insert(curve.x.end(), {1e3 * from, 1e3 * to});
  curve.y.insert(curve.y.end(), {force, force});
}

/// Depth in mm.
Staircase staircase_of(const SampledSpring& s) {
  Staircase stairs{{"sampled, press", {}, {}}, {"sampled, release", {}, {}}};
  const long count = samples_each_way(s);
  for (long k = 0; k < count; ++k) {
    const double here = depth_at(s, k), next = depth_at(s, k + 1);
    hold(stairs.press, here, next, s.stiffness * here);
  }
  for (long k = count; k > 0; --k) {
    const double here = depth_at(s, k), next = depth_at(s, k - 1);
    hold(stairs.release, here, next, s.stiffness * here);
  }
  return stairs;
}

/// Work of the force along a curve [J].
double work_along(const FigureCurve& curve) {
  double work = 0;
  for (std::size_t i = 1; i < curve.x.size(); ++i)
    work += (curve.y[i - 1] + curve.y[i]) / 2 * 1e-3 * (curve.x[i] - curve.x[i - 1]);
  return work;
}

double stored(const SampledSpring& s) { return s.stiffness * s.depth * s.depth / 2; }

FigurePanel panel_of(const SampledSpring& s) {
  const double made = energy_made(s);
  FigurePanel panel;
  panel.title =
      fmt::format("sampled every {:g} ms: {:.3g} mJ made, {:.3g} % of {:.3g} mJ stored",
                  1e3 * s.sample_period, 1e3 * made, 100 * made / stored(s), 1e3 * stored(s));
  panel.across = "depth [mm]";
  panel.value = "force [N]";
  panel.end = 1e3 * s.depth;
  Staircase stairs = staircase_of(s);
  panel.curves = {std::move(stairs.press),
                  std::move(stairs.release),
                  {"spring, both ways", {0, 1e3 * s.depth}, {0, s.stiffness * s.depth}}};
  return panel;
}

}  // namespace

double energy_made(const SampledSpring& spring) {
  const Staircase stairs = staircase_of(spring);
  return -(work_along(stairs.press) + work_along(stairs.release));
}

Figure figure_sampled_spring() {
  const SampledSpring fast;
  SampledSpring slow;
  slow.sample_period = 0.01;
  Figure figure;
  figure.thesis =
      "The held force is too low while pressed and too high while released, so energy is made; no "
      "number is printed.";
  figure.why = fmt::format(
      "agrees: K v T X for speed v and depth X, here {:g} N/m, {:g} m/s, {:g} mm; the numbers are "
      "ours.",
      fast.stiffness, fast.speed, 1e3 * fast.depth);
  figure.numbers = {
      {"energy made by one press and release at 1 ms", 1e3 * energy_made(fast), {}, "mJ"},
      {"share of the stored energy at 1 ms", 100 * energy_made(fast) / stored(fast), {}, "%"},
      {"energy made by one press and release at 10 ms", 1e3 * energy_made(slow), {}, "mJ"},
      {"share of the stored energy at 10 ms", 100 * energy_made(slow) / stored(slow), {}, "%"}};
  figure.panels = {panel_of(slow), panel_of(fast)};
  return figure;
}

}  // namespace reckon::bench
