// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/plots/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/plot_axis.hpp"

namespace reckon::tools {
namespace {

// Of the picture and of the area inside the axes.
constexpr double kWidth = 760;
constexpr double kLeft = 64;
constexpr double kRight = 740;
constexpr double kTop = 66;
constexpr double kBottom = 290;
constexpr double kLegendRow = 18;

/// Told apart on white and on black, and by most who see few colours (Okabe and Ito).
constexpr std::array<std::string_view, SvgPlot::kMostCurves> kColours{
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

constexpr std::string_view kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#24292f}.t{font-size:15px;font-weight:600}"
    ".g{stroke:#d8dee4}.a{stroke:#57606a}.b{fill:#ffffff}"
    "@media(prefers-color-scheme:dark){text{fill:#d0d7de}.g{stroke:#30363d}.a{stroke:#8b949e}"
    ".b{fill:#0d1117}}</style>\n";

auto end_of(std::string& out) { return std::back_inserter(out); }

double sane(float value) { return std::isfinite(value) && value > 0 ? double{value} : 0.0; }

double greatest_of(const SvgPlot& plot) {
  double greatest = 0;
  for (const SvgCurve& curve : plot.curves)
    for (const float value : curve.values) greatest = std::max(greatest, sane(value));
  return greatest;
}

void append_axes(std::string& out, const SvgPlot& plot, double top) {
  const double value_step = round_step(top, 4);
  for (int i = 0; i * value_step <= top * (1 + 1e-9); ++i) {
    const double y = kBottom - (kBottom - kTop) * i * value_step / top;
    append_svg_line(out, "g", kLeft, y, kRight, y);
    append_svg_text(out, kLeft - 8, y + 4, " text-anchor=\"end\"",
                    fmt::format("{:g}", i * value_step));
  }
  const double time_step = round_step(plot.end, 6);
  for (int i = 0; plot.end > 0 && i * time_step <= plot.end * (1 + 1e-9); ++i) {
    const double x = kLeft + (kRight - kLeft) * i * time_step / plot.end;
    append_svg_line(out, "a", x, kBottom, x, kBottom + 5);
    append_svg_text(out, x, kBottom + 19, " text-anchor=\"middle\"",
                    fmt::format("{:g}", i * time_step));
  }
  append_svg_line(out, "a", kLeft, kBottom, kRight, kBottom);
  append_svg_line(out, "a", kLeft, kTop, kLeft, kBottom);
  append_svg_text(out, (kLeft + kRight) / 2, kBottom + 38, " text-anchor=\"middle\"", "time [s]");
  const double middle = (kTop + kBottom) / 2;
  append_svg_text(
      out, 16, middle,
      fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 16 {:.1f})\"", middle),
      plot.value);
}

void append_curve(std::string& out, std::span<const float> values, double top,
                  std::string_view colour) {
  fmt::format_to(end_of(out),
                 "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" "
                 "stroke-linejoin=\"round\" points=\"",
                 colour);
  const auto height = [&](std::size_t i) {
    return kBottom - (kBottom - kTop) * std::min(1.0, sane(values[i]) / top);
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    // What lies on a level stretch need not be said.
    const bool level =
        i > 0 && i + 1 < values.size() && height(i) == height(i - 1) && height(i) == height(i + 1);
    if (level) continue;
    const double share =
        values.size() > 1 ? static_cast<double>(i) / static_cast<double>(values.size() - 1) : 0.0;
    fmt::format_to(end_of(out), "{:.1f},{:.1f} ", kLeft + (kRight - kLeft) * share, height(i));
  }
  out += "\"/>\n";
}

void append_legend(std::string& out, const SvgPlot& plot, std::size_t drawn) {
  double y = kBottom + 62;
  for (std::size_t i = 0; i < drawn; ++i, y += kLegendRow) {
    fmt::format_to(end_of(out),
                   "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                   "stroke-width=\"3\"/>\n",
                   kLeft, y - 4, kLeft + 22, y - 4, kColours[i]);
    append_svg_text(out, kLeft + 30, y, "", plot.curves[i].name);
  }
}

}  // namespace

std::string svg_text(const SvgPlot& plot) {
  const std::size_t drawn = std::min(plot.curves.size(), SvgPlot::kMostCurves);
  const double top = round_end(greatest_of(plot), 4);
  const double height = kBottom + 56 + kLegendRow * static_cast<double>(drawn);
  std::string out;
  fmt::format_to(end_of(out),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
                 "width=\"{0:g}\" height=\"{1:g}\">\n",
                 kWidth, height);
  out += kStyle;
  fmt::format_to(end_of(out), "<rect class=\"b\" width=\"{:g}\" height=\"{:g}\"/>\n", kWidth,
                 height);
  append_svg_text(out, kLeft, 26, " class=\"t\"", plot.title);
  append_svg_text(out, kLeft, 46, "", plot.note);
  append_axes(out, plot, top);
  for (std::size_t i = 0; i < drawn; ++i)
    append_curve(out, plot.curves[i].values, top, kColours[i]);
  append_legend(out, plot, drawn);
  out += "</svg>\n";
  return out;
}

}  // namespace reckon::tools
