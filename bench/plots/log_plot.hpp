// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Curves with two logarithmic axes as a self-contained SVG picture: cost against error. Readable on
// light and dark pages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

struct LogPoint {
  double x = 0, y = 0;
  std::string text;       ///< shown under the pointer; may be empty
  std::size_t piece = 0;  ///< piece of its curve: a line joins one piece; solid, dashed, ..
};

struct LogCurve {
  std::string name;
  std::vector<LogPoint> points;  ///< in drawing order
  bool is_bold = false;
};

/// A point with a label.
struct LogMark {
  LogPoint at;
  std::string label;
  bool below = false;  ///< the label is below the point, where falling curves leave room
};

struct LogPlot {
  std::string title, note;
  std::string x, y;  ///< titles of the axes, with units
  std::vector<LogCurve> curves;
  std::vector<LogMark> marks;

  /// Number of colours, and so of curves that can be distinguished; further curves are not drawn.
  static constexpr std::size_t kMostCurves = 10;

  /// Line style of a piece, in a word; the fifth is the first again.
  [[nodiscard]] static std::string_view dash_name(std::size_t piece);
};

/// The complete file. Points that are not above 0 and finite are omitted; any text is allowed.
[[nodiscard]] std::string log_plot_svg(const LogPlot& plot);

}  // namespace reckon::bench
