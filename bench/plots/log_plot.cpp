// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/plots/log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "reckon/bench/plots/log_axis.hpp"
#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::bench {
namespace {

// Sizes of the picture and of the area inside the axes.
constexpr double kWidth = 760;
constexpr double kLeft = 76;
constexpr double kRight = 740;
constexpr double kTop = 70;
constexpr double kBottom = 430;
constexpr double kLegendRow = 20;
constexpr double kLegendColumn = 166;
constexpr std::size_t kLegendColumns = 4;

/// Distinguishable on white and on black, and by most colour-blind people (the first are from Okabe
/// and Ito).
constexpr std::array<std::string_view, LogPlot::kMostCurves> kColours{
    "#d55e00", "#0072b2", "#56b4e9", "#009e73", "#8bc34a",
    "#cc79a7", "#e69f00", "#999999", "#7e57c2", "#795548"};

constexpr std::string_view kStyle =
    "<style>.k{fill:none;stroke:#24292f;stroke-width:2}@media(prefers-color-scheme:dark){.k{stroke:"
    "#d0d7de}}</style>\n";

struct Dash {
  std::string_view name, pattern;
};
constexpr std::array kDashes{Dash{"solid", "none"}, Dash{"dashed", "7 4"}, Dash{"dotted", "1.5 3"},
                             Dash{"dash and dot", "9 3 1.5 3"}};

bool is_drawn(const LogPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0;
}

/// Ticks from a million have a letter.
std::string tick_text(double tick) {
  if (tick >= 1e9) return fmt::format("{:g} G", 1e-9 * tick);
  return tick >= 1e6 ? fmt::format("{:g} M", 1e-6 * tick) : fmt::format("{:g}", tick);
}

struct Axes {
  LogAxis x, y;
};

Axes axes_of(const LogPlot& plot, std::size_t drawn) {
  std::vector<double> across, up;
  const auto hold = [&](const LogPoint& point) {
    if (!is_drawn(point)) return;
    across.push_back(point.x);
    up.push_back(point.y);
  };
  for (std::size_t i = 0; i < drawn; ++i)
    for (const LogPoint& point : plot.curves[i].points) hold(point);
  for (const LogMark& mark : plot.marks) hold(mark.at);
  return {log_axis_over(across, 0, kLeft, kRight, 0), log_axis_over(up, 0, kBottom, kTop, 0)};
}

void append_curve(std::string& out, const LogCurve& curve, const Axes& axes,
                  std::string_view colour) {
  for (auto first = curve.points.begin(); first != curve.points.end();) {
    const auto last = std::find_if(first, curve.points.end(), [first](const LogPoint& point) {
      return point.piece != first->piece;
    });
    fmt::format_to(tools::end_of(out),
                   "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                   "stroke-dasharray=\"{}\" points=\"",
                   colour, curve.is_bold ? 3 : 1.2, kDashes[first->piece % kDashes.size()].pattern);
    for (; first != last; ++first)
      if (is_drawn(*first))
        fmt::format_to(tools::end_of(out), "{:.1f},{:.1f} ", axes.x.at(first->x),
                       axes.y.at(first->y));
    out += "\"/>\n";
  }
  for (const LogPoint& point : curve.points) {
    if (!is_drawn(point)) continue;
    fmt::format_to(tools::end_of(out),
                   "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"><title>",
                   axes.x.at(point.x), axes.y.at(point.y), curve.is_bold ? 4 : 2.5, colour);
    tools::append_svg_escaped(out, point.text);
    out += "</title></circle>\n";
  }
}

void append_mark(std::string& out, const LogMark& mark, const Axes& axes) {
  if (!is_drawn(mark.at)) return;
  const double x = axes.x.at(mark.at.x);
  const double y = axes.y.at(mark.at.y);
  fmt::format_to(tools::end_of(out), "<circle class=\"k\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\"/>\n",
                 x, y);
  // Curves fall from the upper left: there is free space below them to the left and above them to
  // the right.
  const bool left = mark.below ? x > kLeft + 160 : x > kRight - 160;
  tools::append_svg_text(out, left ? x - 12 : x + 12, mark.below ? y + 22 : y - 10,
                         left ? " class=\"m\" text-anchor=\"end\"" : " class=\"m\"", mark.label);
}

void append_legend(std::string& out, const LogPlot& plot, std::size_t drawn) {
  for (std::size_t i = 0; i < drawn; ++i) {
    const double x = kLeft + kLegendColumn * static_cast<double>(i % kLegendColumns);
    const double y = kBottom + 68 + kLegendRow * static_cast<double>(i / kLegendColumns);
    fmt::format_to(tools::end_of(out),
                   "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                   "stroke-width=\"3\"/>\n",
                   x, y - 4, x + 22, y - 4, kColours[i]);
    tools::append_svg_text(out, x + 30, y, "", plot.curves[i].name);
  }
}

}  // namespace

std::string_view LogPlot::dash_name(std::size_t piece) {
  return kDashes[piece % kDashes.size()].name;
}

std::string log_plot_svg(const LogPlot& plot) {
  const std::size_t drawn = std::min(plot.curves.size(), LogPlot::kMostCurves);
  const Axes axes = axes_of(plot, drawn);
  const std::size_t rows = (drawn + kLegendColumns - 1) / kLegendColumns;
  const double height = kBottom + 62 + kLegendRow * static_cast<double>(rows);
  std::string inside(kStyle);
  tools::append_svg_text(inside, kLeft, 26, " class=\"t\"", plot.title);
  tools::append_svg_text(inside, kLeft, 48, "", plot.note);
  append_log_grid(inside, {axes.x, plot.x, tick_text}, {axes.y, plot.y, tick_text});
  for (std::size_t i = drawn; i-- > 0;) append_curve(inside, plot.curves[i], axes, kColours[i]);
  for (const LogMark& mark : plot.marks) append_mark(inside, mark, axes);
  append_legend(inside, plot, drawn);
  return tools::svg_picture(inside, kWidth, height);
}

}  // namespace reckon::bench
