// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/scene_curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reckon::bench {

std::string axis_title(Quantity quantity) {
  return (quantity == Quantity::force ? "force [" : "velocity [") + unit_of(quantity) + "]";
}

std::string unit_of(Quantity quantity) { return quantity == Quantity::force ? "N" : "m/s"; }

std::string reading_name(SpringReading reading) {
  return reading == SpringReading::with_period ? "K with T" : "K, no T";
}

double value_of(const SceneSample& sample, Quantity quantity) {
  return quantity == Quantity::force ? sample.force : sample.velocity;
}

FigureCurve curve_of(std::string name, const std::vector<SceneSample>& series, Quantity quantity) {
  FigureCurve curve{std::move(name), {}, {}};
  for (const SceneSample& sample : series) {
    curve.x.push_back(sample.time);
    curve.y.push_back(value_of(sample, quantity));
  }
  return curve;
}

FigureCurve curve_of(std::string name, const std::vector<std::array<SceneSample, 2>>& series,
                     std::size_t user, Quantity quantity) {
  FigureCurve curve{std::move(name), {}, {}};
  for (const auto& samples : series) {
    curve.x.push_back(samples[user].time);
    curve.y.push_back(value_of(samples[user], quantity));
  }
  return curve;
}

FigurePanel panel_over_time(std::string title, Quantity quantity, double duration) {
  FigurePanel panel;
  panel.title = std::move(title);
  panel.across = "time [s]";
  panel.value = axis_title(quantity);
  panel.end = duration;
  return panel;
}

double greatest(const FigureCurve& curve) {
  double most = 0;
  for (const double value : curve.y) most = std::max(most, std::abs(value));
  return most;
}

double settled_after(const FigureCurve& curve, double share) {
  const double band = share * std::abs(curve.y.back());
  std::size_t i = curve.y.size();
  while (i > 0 && std::abs(curve.y[i - 1] - curve.y.back()) <= band) --i;
  return i < curve.x.size() ? curve.x[i] : 0.0;
}

}  // namespace reckon::bench
