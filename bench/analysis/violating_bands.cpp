// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/violating_bands.hpp"

#include <cmath>
#include <stdexcept>

namespace reckon::bench {
namespace {

using Margin = std::function<double(double)>;

bool violates(const Margin& margin, double x) {
  const double value = margin(x);
  if (std::isnan(value)) {
    throw std::invalid_argument("frequency bands: the margin at " + std::to_string(x) +
                                " is not a number; leave poles out of the range");
  }
  return value < 0;
}

// The sign of the margin changes between a and b.
double edge(const Margin& margin, double a, double b) {
  const bool at_a = violates(margin, a);
  while (b - a > 1e-12 * b) {
    const double middle = 0.5 * (a + b);
    if (middle <= a || middle >= b) break;
    (violates(margin, middle) == at_a ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

std::vector<Band> violating_bands(const Margin& margin, double low, double high, int points) {
  if (!(low > 0) || !(high > low) || !std::isfinite(high) || points < 2) {
    throw std::invalid_argument("frequency bands: give 0 < low < high and 2 or more points");
  }
  std::vector<Band> bands;
  double last = low;
  bool inside = violates(margin, low);
  if (inside) bands.push_back({low, high});
  for (int i = 1; i < points; ++i) {
    const double x = i == points - 1 ? high : low * std::pow(high / low, i / (points - 1.0));
    const bool now = violates(margin, x);
    if (now && !inside) bands.push_back({edge(margin, last, x), high});
    if (!now && inside) bands.back().high = edge(margin, last, x);
    inside = now;
    last = x;
  }
  return bands;
}

}  // namespace reckon::bench
