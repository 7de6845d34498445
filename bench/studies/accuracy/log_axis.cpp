// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/log_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::bench {

double LogAxis::at(double value) const {
  const double inside = std::clamp(value, low, high);
  return begin + (finish - begin) * std::log(inside / low) / std::log(high / low);
}

std::vector<double> LogAxis::ticks() const {
  std::vector<double> ticks;
  const bool few = high / low < 3e3;
  for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * decade;
      if ((few || factor == 1) && tick >= low * 0.999 && tick <= high * 1.001)
        ticks.push_back(tick);
    }
  }
  return ticks;
}

LogAxis log_axis_over(std::span<const double> values, double floor, double begin, double finish) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    high = std::max(high, value);
    if (value >= floor) low = std::min(low, value);
  }
  low = std::min(low, high);
  if (!(high > 0)) low = high = 1;
  const double widen = std::max(1.25, std::sqrt(10 * low / high));
  return {low / widen, high * widen, begin, finish};
}

}  // namespace reckon::bench
