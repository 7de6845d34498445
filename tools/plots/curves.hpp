// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Curves, mostly over time, as a self-contained SVG picture: title, axes with ticks, legend;
// readable on light and dark pages.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// One curve: evenly spaced over the time of the plot, or at the positions in `at`.
struct SvgCurve {
  std::string name;
  std::span<const float> values;
  std::span<const float> at = {};  ///< horizontal positions, one per value; empty: evenly spaced
  bool as_points = false;          ///< circles instead of a line: measured values
};

struct SvgPlot {
  std::string title;
  std::string note;   ///< a sentence below the title; may be empty
  std::string value;  ///< title of the vertical axis, with unit: "force [N]"
  double end = 0;     ///< of the horizontal axis, which begins at 0 [s]
  std::vector<SvgCurve> curves;
  std::string across = "time [s]";  ///< title of the horizontal axis, with unit
  bool is_signed = false;           ///< values below 0 are drawn, and the axis covers them
  /// Ends of the vertical axis, below and above 0; curves are clipped there. Empty: it covers all
  /// values.
  std::optional<std::array<double, 2>> range;

  /// Number of colours, and so of curves that can be distinguished; further curves are not drawn.
  static constexpr std::size_t kMostCurves = 6;
};

/// The whole file. Values that are not finite, or below 0 if the plot is not signed, are drawn
/// as 0; accepts texts of any octets.
[[nodiscard]] std::string svg_text(const SvgPlot& plot);

/// Several plots in one picture, one below the other: its title, lines of notes, and each plot with
/// its title. Legends in columns; curves also differ by dashes, for print without colour.
[[nodiscard]] std::string svg_panels(std::string_view title, std::span<const std::string> notes,
                                     std::span<const SvgPlot> plots);

}  // namespace reckon::tools
