// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/plots/log_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::bench {
namespace {

// Of the picture and of the area inside the axes.
constexpr double kWidth = 760;
constexpr double kLeft = 76;
constexpr double kRight = 740;
constexpr double kTop = 70;
constexpr double kBottom = 430;
constexpr double kLegendRow = 20;
constexpr double kLegendColumn = 166;
constexpr std::size_t kLegendColumns = 4;

/// Told apart on white and on black, and by most who see few colours (Okabe and Ito first).
constexpr std::array<std::string_view, LogPlot::kMostCurves> kColours{
    "#d55e00", "#0072b2", "#56b4e9", "#009e73", "#8bc34a",
    "#cc79a7", "#e69f00", "#999999", "#7e57c2", "#795548"};

constexpr std::string_view kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#24292f}.t{font-size:15px;font-weight:600}"
    ".m{font-weight:600}.g{stroke:#e6eaee}.a{stroke:#57606a}.b{fill:#ffffff}"
    ".k{fill:none;stroke:#24292f;stroke-width:2}"
    "@media(prefers-color-scheme:dark){text{fill:#d0d7de}.g{stroke:#262c33}.a{stroke:#8b949e}"
    ".b{fill:#0d1117}.k{stroke:#d0d7de}}</style>\n";

struct Dash {
  std::string_view name, pattern;
};
constexpr std::array kDashes{Dash{"solid", "none"}, Dash{"dashed", "7 4"}, Dash{"dotted", "1.5 3"},
                             Dash{"dash and dot", "9 3 1.5 3"}};

bool is_drawn(const LogPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0;
}

/// A logarithmic axis on the picture, with some room at both ends.
class Axis {
 public:
  Axis(double begin, double end) : begin_(begin), end_(end) {}

  void hold(double value) {
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }
  void settle() {
    if (least_ > most_) least_ = most_ = 1;
    least_ = std::log10(least_) - 0.1;
    most_ = std::log10(most_) + 0.1;
  }
  [[nodiscard]] double at(double value) const {
    return begin_ + (end_ - begin_) * (std::log10(value) - least_) / (most_ - least_);
  }
  /// 1, 2, 5 times powers of ten; the powers alone where these would be too many, more of them
  /// where they would be fewer than three.
  [[nodiscard]] std::vector<double> ticks() const {
    if (most_ - least_ > 4) return ticks_at(kDecades);
    std::vector<double> ticks;
    for (const std::span<const double> steps : {kCoarse, kFine, kFinest}) {
      ticks = ticks_at(steps);
      if (ticks.size() >= 3) break;
    }
    return ticks;
  }

 private:
  static constexpr std::array kFineSteps{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  static constexpr std::array kFinestSteps{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8,
                                           2.0, 2.2, 2.5, 2.8, 3.0, 3.5, 4.0, 4.5,
                                           5.0, 5.5, 6.0, 6.5, 7.0, 8.0, 9.0};
  static constexpr std::array kCoarseSteps{1.0, 2.0, 5.0};
  static constexpr std::span<const double> kCoarse{kCoarseSteps}, kFine{kFineSteps},
      kFinest{kFinestSteps}, kDecades{kCoarse.first(1)};

  [[nodiscard]] std::vector<double> ticks_at(std::span<const double> steps) const {
    std::vector<double> ticks;
    for (int decade = static_cast<int>(std::floor(least_)); decade <= most_; ++decade)
      for (const double step : steps) {
        const double value = step * std::pow(10.0, decade);
        if (std::log10(value) >= least_ && std::log10(value) <= most_) ticks.push_back(value);
      }
    return ticks;
  }

  double begin_, end_;                    // [px]
  double least_ = 1e300, most_ = -1e300;  // value, after settle() its log10
};

/// A million and more by letter.
std::string tick_text(double tick) {
  if (tick >= 1e9) return fmt::format("{:g} G", 1e-9 * tick);
  return tick >= 1e6 ? fmt::format("{:g} M", 1e-6 * tick) : fmt::format("{:g}", tick);
}

struct Axes {
  Axis x{kLeft, kRight}, y{kBottom, kTop};
};

Axes axes_of(const LogPlot& plot, std::size_t drawn) {
  Axes axes;
  const auto hold = [&](const LogPoint& point) {
    if (!is_drawn(point)) return;
    axes.x.hold(point.x);
    axes.y.hold(point.y);
  };
  for (std::size_t i = 0; i < drawn; ++i)
    for (const LogPoint& point : plot.curves[i].points) hold(point);
  for (const LogMark& mark : plot.marks) hold(mark.at);
  axes.x.settle();
  axes.y.settle();
  return axes;
}

void append_axes(std::string& out, const LogPlot& plot, const Axes& axes) {
  for (const double tick : axes.y.ticks()) {
    tools::append_svg_line(out, "g", kLeft, axes.y.at(tick), kRight, axes.y.at(tick));
    tools::append_svg_text(out, kLeft - 8, axes.y.at(tick) + 4, " text-anchor=\"end\"",
                           tick_text(tick));
  }
  for (const double tick : axes.x.ticks()) {
    tools::append_svg_line(out, "g", axes.x.at(tick), kTop, axes.x.at(tick), kBottom);
    tools::append_svg_text(out, axes.x.at(tick), kBottom + 19, " text-anchor=\"middle\"",
                           tick_text(tick));
  }
  tools::append_svg_line(out, "a", kLeft, kBottom, kRight, kBottom);
  tools::append_svg_line(out, "a", kLeft, kTop, kLeft, kBottom);
  tools::append_svg_text(out, (kLeft + kRight) / 2, kBottom + 40, " text-anchor=\"middle\"",
                         plot.x);
  const double middle = (kTop + kBottom) / 2;
  tools::append_svg_text(
      out, 18, middle,
      fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 18 {:.1f})\"", middle), plot.y);
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
  // Curves fall from the upper left: beside them there is room below to the left, above to the
  // right.
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
  std::string out;
  fmt::format_to(tools::end_of(out),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
                 "width=\"{0:g}\" height=\"{1:g}\">\n",
                 kWidth, height);
  out += kStyle;
  fmt::format_to(tools::end_of(out), "<rect class=\"b\" width=\"{:g}\" height=\"{:g}\"/>\n", kWidth,
                 height);
  tools::append_svg_text(out, kLeft, 26, " class=\"t\"", plot.title);
  tools::append_svg_text(out, kLeft, 48, "", plot.note);
  append_axes(out, plot, axes);
  for (std::size_t i = drawn; i-- > 0;) append_curve(out, plot.curves[i], axes, kColours[i]);
  for (const LogMark& mark : plot.marks) append_mark(out, mark, axes);
  append_legend(out, plot, drawn);
  out += "</svg>\n";
  return out;
}

}  // namespace reckon::bench
