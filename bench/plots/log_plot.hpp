// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Curves with both axes logarithmic as a self-contained SVG picture: cost against error. Readable
// on light and dark pages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

struct LogPoint {
  double x = 0, y = 0;
  std::string text;       ///< shown where a pointer rests on it; may be empty
  std::size_t piece = 0;  ///< of its curve: a line joins neighbours of one piece; solid, dashed, ..
};

struct LogCurve {
  std::string name;
  std::vector<LogPoint> points;  ///< in the order of drawing
  bool is_bold = false;
};

/// A point with words beside it.
struct LogMark {
  LogPoint at;
  std::string label;
  bool below = false;  ///< the words below the point, where curves that fall leave room
};

struct LogPlot {
  std::string title, note;
  std::string x, y;  ///< titles of the axes, with units
  std::vector<LogCurve> curves;
  std::vector<LogMark> marks;

  /// Colours, and so curves that can be told apart; more are not drawn.
  static constexpr std::size_t kMostCurves = 10;

  /// How the lines of a piece are drawn, in a word; after four the first comes again.
  [[nodiscard]] static std::string_view dash_name(std::size_t piece);
};

/// The whole file. Points that are not above 0 and finite are left out; text of any octets will do.
[[nodiscard]] std::string log_plot_svg(const LogPlot& plot);

}  // namespace reckon::bench
