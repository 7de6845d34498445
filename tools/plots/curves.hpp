// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Curves over time as a self-contained SVG picture: title, axes with ticks, legend; readable on
// light and dark pages.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace reckon::tools {

/// One curve, evenly spaced over the time of the plot.
struct SvgCurve {
  std::string name;
  std::span<const float> values;
};

struct SvgPlot {
  std::string title;
  std::string note;   ///< a sentence below the title; may be empty
  std::string value;  ///< title of the upright axis, with unit: "force [N]"
  double end = 0;     ///< of the time axis, which begins at 0 [s]
  std::vector<SvgCurve> curves;

  /// Colours, and so curves that can be told apart; more are not drawn.
  static constexpr std::size_t kMostCurves = 6;
};

/// The whole file. Values that are not finite or below 0 are drawn as 0; text of any octets will
/// do.
[[nodiscard]] std::string svg_text(const SvgPlot& plot);

}  // namespace reckon::tools
