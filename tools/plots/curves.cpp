// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/plots/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/plot_axis.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::tools {
namespace {

// Size of the picture and of the area inside the axes; the top of the area varies.
constexpr double kWidth = 760;
constexpr double kLeft = 64;
constexpr double kRight = 740;
constexpr double kTop = 66;
constexpr double kTall = 224;
constexpr double kLegendRow = 18;
constexpr std::size_t kLegendColumns = 3;
/// Points are dropped as long as the line moves by less than this [px].
constexpr double kStraight = 0.05;
/// Far outside the picture [px]; SVG renderers fail on much larger values.
constexpr double kFar = 1e4;

/// Distinct on white and on black, and for most colour-blind readers (Okabe and Ito).
constexpr std::array<std::string_view, SvgPlot::kMostCurves> kColours{
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

constexpr std::array<std::string_view, SvgPlot::kMostCurves> kDashes{"",         "7 4", "2 3",
                                                                     "10 3 2 3", "4 2", "1 2"};

struct Point {
  double x = 0, y = 0;
};

/// One plot of the picture.
class Area {
 public:
  Area(const SvgPlot& plot, double top);

  [[nodiscard]] double top() const { return top_; }
  [[nodiscard]] double bottom() const { return top_ + kTall; }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  [[nodiscard]] double value_step() const { return step_; }
  [[nodiscard]] double x(double at) const {
    return plot_.end > 0 ? kLeft + (kRight - kLeft) * at / plot_.end : kLeft;
  }
  [[nodiscard]] double y(double value) const {
    return std::clamp(bottom() - kTall * (value - low_) / (high_ - low_), -kFar, kFar);
  }
  [[nodiscard]] std::vector<Point> points(const SvgCurve& curve) const;

 private:
  [[nodiscard]] double sane(float value) const {
    return std::isfinite(value) && (plot_.is_signed || value > 0) ? double{value} : 0.0;
  }

  const SvgPlot& plot_;
  double top_;
  double low_ = 0, high_ = 0, step_ = 1;
};

Area::Area(const SvgPlot& plot, double top) : plot_(plot), top_(top) {
  for (const SvgCurve& curve : plot.curves) {
    for (const float value : curve.values) {
      low_ = std::min(low_, sane(value));
      high_ = std::max(high_, sane(value));
    }
  }
  if (plot.range) {
    low_ = (*plot.range)[0];
    high_ = (*plot.range)[1];
  }
  step_ = round_step(high_ - low_, 4);
  if (!plot.range) {
    high_ = low_ < 0 ? step_ * std::ceil(high_ / step_ - 1e-9) : round_end(high_, 4);
    low_ = step_ * std::floor(low_ / step_ + 1e-9);
  }
}

std::vector<Point> Area::points(const SvgCurve& curve) const {
  std::vector<Point> points;
  const std::size_t count =
      curve.at.empty() ? curve.values.size() : std::min(curve.at.size(), curve.values.size());
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
    points.push_back({curve.at.empty() ? kLeft + (kRight - kLeft) * share : x(sane(curve.at[i])),
                      y(sane(curve.values[i]))});
  }
  return points;
}

double distance_to_line(const Point& p, const Point& a, const Point& b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0) return std::hypot(p.x - a.x, p.y - a.y);
  return std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
}

/// The points that the line needs, including its ends (Douglas and Peucker).
std::vector<Point> straightened(std::span<const Point> points) {
  if (points.size() < 3) return {points.begin(), points.end()};
  std::vector<bool> kept(points.size());
  kept.front() = kept.back() = true;
  std::vector<std::array<std::size_t, 2>> pieces{{0, points.size() - 1}};
  while (!pieces.empty()) {
    const auto [first, last] = pieces.back();
    pieces.pop_back();
    std::size_t farthest = first;
    double most = kStraight;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = distance_to_line(points[i], points[first], points[last]);
      if (distance > most) {
        most = distance;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    pieces.push_back({first, farthest});
    pieces.push_back({farthest, last});
  }
  std::vector<Point> rest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) rest.push_back(points[i]);
  return rest;
}

void append_axes(std::string& out, const SvgPlot& plot, const Area& area) {
  const double step = area.value_step();
  const auto first = static_cast<int>(std::ceil(area.low() / step - 1e-9));
  for (int i = first; i * step <= area.high() + 1e-9 * step; ++i) {
    append_svg_line(out, i == 0 && area.low() < 0 ? "a" : "g", kLeft, area.y(i * step), kRight,
                    area.y(i * step));
    append_svg_text(out, kLeft - 8, area.y(i * step) + 4, " text-anchor=\"end\"",
                    fmt::format("{:g}", i * step));
  }
  const double time_step = round_step(plot.end, 6);
  for (int i = 0; plot.end > 0 && i * time_step <= plot.end * (1 + 1e-9); ++i) {
    const double x = area.x(i * time_step);
    append_svg_line(out, "a", x, area.bottom(), x, area.bottom() + 5);
    append_svg_text(out, x, area.bottom() + 19, " text-anchor=\"middle\"",
                    fmt::format("{:g}", i * time_step));
  }
  append_svg_line(out, "a", kLeft, area.bottom(), kRight, area.bottom());
  append_svg_line(out, "a", kLeft, area.top(), kLeft, area.bottom());
  append_svg_text(out, (kLeft + kRight) / 2, area.bottom() + 38, " text-anchor=\"middle\"",
                  plot.across);
  const double middle = (area.top() + area.bottom()) / 2;
  append_svg_text(
      out, 16, middle,
      fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 16 {:.1f})\"", middle),
      plot.value);
}

std::string dashes_text(std::string_view dashes) {
  return dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes);
}

void append_curve(std::string& out, std::span<const Point> points, std::size_t number,
                  bool dashed) {
  fmt::format_to(end_of(out),
                 "<polyline fill=\"none\" stroke=\"{}\"{} stroke-width=\"1.5\" "
                 "stroke-linejoin=\"round\" points=\"",
                 kColours[number], dashes_text(dashed ? kDashes[number] : ""));
  for (const Point& point : straightened(points))
    fmt::format_to(end_of(out), "{:.1f},{:.1f} ", point.x, point.y);
  out += "\"/>\n";
}

void append_circles(std::string& out, std::span<const Point> points, std::size_t number) {
  for (const Point& point : points)
    fmt::format_to(end_of(out),
                   "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"none\" stroke=\"{}\" "
                   "stroke-width=\"1.5\"/>\n",
                   point.x, point.y, kColours[number]);
}

void append_legend(std::string& out, const SvgPlot& plot, double top, std::size_t columns,
                   bool dashed) {
  const std::size_t drawn = std::min(plot.curves.size(), SvgPlot::kMostCurves);
  for (std::size_t i = 0; i < drawn; ++i) {
    const double x =
        kLeft + (kRight - kLeft) / static_cast<double>(columns) * static_cast<double>(i % columns);
    const double y = top + kLegendRow * static_cast<double>(i / columns);
    if (plot.curves[i].as_points)
      append_circles(out, std::array{Point{x + 11, y - 4}}, i);
    else
      fmt::format_to(
          end_of(out),
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"{} "
          "stroke-width=\"3\"/>\n",
          x, y - 4, x + 22, y - 4, kColours[i], dashes_text(dashed ? kDashes[i] : ""));
    append_svg_text(out, x + 30, y, "", plot.curves[i].name);
  }
}

/// Appends the plot with axes, curves and legend. @returns its lower end
double append_plot(std::string& out, const SvgPlot& plot, double top, std::size_t columns,
                   bool dashed) {
  const Area area(plot, top);
  append_axes(out, plot, area);
  // A nested picture clips the curves to the area.
  fmt::format_to(end_of(out),
                 "<svg x=\"{0:g}\" y=\"{1:g}\" width=\"{2:g}\" height=\"{3:g}\" "
                 "viewBox=\"{0:g} {1:g} {2:g} {3:g}\">\n",
                 kLeft, area.top() - 1, kRight - kLeft + 1, kTall + 2);
  const std::size_t drawn = std::min(plot.curves.size(), SvgPlot::kMostCurves);
  for (std::size_t i = 0; i < drawn; ++i) {
    if (plot.curves[i].as_points)
      append_circles(out, area.points(plot.curves[i]), i);
    else
      append_curve(out, area.points(plot.curves[i]), i, dashed);
  }
  out += "</svg>\n";
  append_legend(out, plot, area.bottom() + 62, columns, dashed);
  const std::size_t rows = (drawn + columns - 1) / columns;
  return area.bottom() + 56 + kLegendRow * static_cast<double>(rows);
}

}  // namespace

std::string svg_text(const SvgPlot& plot) {
  std::string inside;
  append_svg_text(inside, kLeft, 26, " class=\"t\"", plot.title);
  append_svg_text(inside, kLeft, 46, "", plot.note);
  const double height = append_plot(inside, plot, kTop, 1, false);
  return svg_picture(inside, kWidth, height);
}

std::string svg_panels(std::string_view title, std::span<const std::string> notes,
                       std::span<const SvgPlot> plots) {
  std::string inside;
  append_svg_text(inside, kLeft, 26, " class=\"t\"", title);
  double height = 46;
  for (const std::string& note : notes) {
    append_svg_text(inside, kLeft, height, "", note);
    height += kSvgNoteRow;
  }
  for (const SvgPlot& plot : plots) {
    append_svg_text(inside, kLeft, height + 12, " class=\"m\"", plot.title);
    height = append_plot(inside, plot, height + 24, kLegendColumns, true) + 10;
  }
  return svg_picture(inside, kWidth, height);
}

}  // namespace reckon::tools
