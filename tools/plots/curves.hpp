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

/// One curve: evenly spaced over the time of the plot, or at the places in `at`.
struct SvgCurve {
  std::string name;
  std::span<const float> values;
  std::span<const float> at = {};  ///< on the level axis, one a value; empty: evenly spaced
  bool as_points = false;          ///< circles in the place of a line: what was measured
};

struct SvgPlot {
  std::string title;
  std::string note;   ///< a sentence below the title; may be empty
  std::string value;  ///< title of the upright axis, with unit: "force [N]"
  double end = 0;     ///< of the level axis, which begins at 0 [s]
  std::vector<SvgCurve> curves;
  std::string across = "time [s]";  ///< title of the level axis, with unit
  bool is_signed = false;           ///< values below 0 are drawn, with an axis that holds them
  /// Ends of the upright axis, below and above 0; curves are cut there. Empty: it holds all values.
  std::optional<std::array<double, 2>> range;

  /// Colours, and so curves that can be distinguished; more are not drawn.
  static constexpr std::size_t kMostCurves = 6;
};

/// The whole file. Values that are not finite, or below 0 where the plot is not signed, are drawn
/// as 0; text of any octets will do.
[[nodiscard]] std::string svg_text(const SvgPlot& plot);

/// Plots one below the other as one picture: its title, lines of notes, and over each plot that
/// plot's title. Legends in columns; curves differ by dashes too, for print without colour.
[[nodiscard]] std::string svg_panels(std::string_view title, std::span<const std::string> notes,
                                     std::span<const SvgPlot> plots);

}  // namespace reckon::tools
