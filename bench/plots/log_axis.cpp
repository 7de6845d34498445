// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/plots/log_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reckon/tools/plots/svg_elements.hpp"

namespace reckon::bench {
namespace {

constexpr std::array kCoarse{1.0, 2.0, 5.0};
constexpr std::array kFine{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
constexpr std::array kFinest{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2.0, 2.2, 2.5, 2.8,
                             3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 8.0, 9.0};
constexpr double kMany = 3e3;  // ratio of highest to lowest: powers of ten only

std::vector<double> ticks_at(const LogAxis& axis, std::span<const double> steps) {
  std::vector<double> ticks;
  for (int decade = static_cast<int>(std::floor(std::log10(axis.low)));
       std::pow(10.0, decade) <= axis.high; ++decade) {
    for (const double step : steps) {
      const double tick = step * std::pow(10.0, decade);
      if (tick >= axis.low * 0.999 && tick <= axis.high * 1.001) ticks.push_back(tick);
    }
  }
  return ticks;
}

}  // namespace

double LogAxis::at(double value) const {
  const double inside = std::clamp(value, low, high);
  return begin + (finish - begin) * std::log(inside / low) / std::log(high / low);
}

std::vector<double> LogAxis::ticks() const {
  if (high / low >= kMany) return ticks_at(*this, std::span(kCoarse).first(1));
  std::vector<double> ticks;
  for (const std::span<const double> steps :
       {std::span<const double>(kCoarse), std::span<const double>(kFine),
        std::span<const double>(kFinest)}) {
    ticks = ticks_at(*this, steps);
    if (ticks.size() >= 3) break;
  }
  return ticks;
}

LogAxis log_axis_over(std::span<const double> values, double floor, double begin, double finish,
                      double decades) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    high = std::max(high, value);
    if (value >= floor) low = std::min(low, value);
  }
  low = std::min(low, high);
  if (!(high > 0)) low = high = 1;
  const double widen = std::max(1.25, std::sqrt(std::pow(10.0, decades) * low / high));
  return {low / widen, high * widen, begin, finish};
}

void append_log_grid(std::string& out, const LogScale& x, const LogScale& y) {
  const double left = x.axis.begin, right = x.axis.finish;
  const double bottom = y.axis.begin, top = y.axis.finish;
  for (const double tick : y.axis.ticks()) {
    const double at = y.axis.at(tick);
    tools::append_svg_line(out, "g", left, at, right, at);
    tools::append_svg_text(out, left - 8, at + 4, " text-anchor=\"end\"", y.text(tick));
  }
  for (const double tick : x.axis.ticks()) {
    const double at = x.axis.at(tick);
    tools::append_svg_line(out, "g", at, top, at, bottom);
    tools::append_svg_text(out, at, bottom + 19, " text-anchor=\"middle\"", x.text(tick));
  }
  tools::append_svg_line(out, "a", left, bottom, right, bottom);
  tools::append_svg_line(out, "a", left, top, left, bottom);
  tools::append_svg_text(out, (left + right) / 2, bottom + 40, " text-anchor=\"middle\"", x.title);
  const double middle = (top + bottom) / 2;
  tools::append_svg_text(
      out, 16, middle,
      fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 16 {:.1f})\"", middle), y.title);
}

}  // namespace reckon::bench
