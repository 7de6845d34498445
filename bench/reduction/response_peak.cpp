// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/response_peak.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/bench/linear_systems/golden_section.hpp"

namespace reckon::bench {
namespace {

constexpr double kPrecision = 1e-6;  // of the frequency
constexpr double kMayBePeak = 0.5;   // of the greatest value on the grid
constexpr double kWidths[] = {0.15, 0.5, 1.0, 2.0, 4.0, 8.0};

}  // namespace

ResponsePeak response_peak(const std::function<double(double)>& of, std::vector<double> grid,
                           double enough) {
  std::sort(grid.begin(), grid.end());
  // Nearly equal frequencies, as of equal modes, would hide values beyond each other.
  const auto twins = [](double a, double b) { return b - a <= kPrecision * b; };
  grid.erase(std::unique(grid.begin(), grid.end(), twins), grid.end());
  std::vector<double> values;
  values.reserve(grid.size());
  for (double w : grid) {
    values.push_back(of(w));
    if (values.back() > enough) return {values.back(), w};
  }
  ResponsePeak peak;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (values[i] > peak.value) peak = {values[i], grid[i]};
  }
  const double may_be = kMayBePeak * peak.value;
  for (std::size_t i = 1; i + 1 < grid.size(); ++i) {
    if (values[i] < may_be || values[i] < values[i - 1] || values[i] < values[i + 1]) continue;
    const Greatest refined = greatest_between(grid[i - 1], grid[i + 1], kPrecision * grid[i], of);
    if (refined.value > peak.value) peak = {refined.value, refined.at};
  }
  return peak;
}

std::vector<double> frequency_grid(double lowest, double highest, int count) {
  std::vector<double> grid;
  grid.reserve(static_cast<std::size_t>(count));
  const double ratio = std::log(highest / lowest) / (count - 1);
  for (int i = 0; i < count; ++i) grid.push_back(lowest * std::exp(ratio * i));
  grid.back() = highest;
  return grid;
}

void near_resonance(double angular_frequency, double half_width, std::vector<double>& grid) {
  grid.push_back(angular_frequency);
  for (double width : kWidths) {
    grid.push_back(angular_frequency + width * half_width);
    if (angular_frequency > width * half_width) {
      grid.push_back(angular_frequency - width * half_width);
    }
  }
}

}  // namespace reckon::bench
