// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One figure of the thesis as data: what it shows, what the thesis says of it and what we get; an
// experiment with its numbers and curves, or a drawing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reckon/bench/plots/diagram.hpp"

namespace reckon::bench {

struct FigureCurve {
  std::string name;
  std::vector<double> x, y;  ///< as long as each other, in the units of the panel's axes
};

/// One pair of axes.
struct FigurePanel {
  std::string title;
  std::string across, value;  ///< titles of the axes, with units
  double end = 0;             ///< of the level axis, which begins at 0; curves are cut there
  std::optional<std::array<double, 2>> range;  ///< of the upright axis; curves are cut there
  std::vector<FigureCurve> curves;
};

/// A number that the figure is about.
struct FigureNumber {
  std::string what;
  double ours = 0;               ///< finite
  std::optional<double> thesis;  ///< where the thesis prints one
  std::string unit;
};

struct Figure {
  std::string thesis;  ///< what it says, in a line
  /// Why ours differs, or "not reproducible, because .."; of a drawing what Reckon has in its
  /// place.
  std::string why;
  std::vector<FigureNumber> numbers;  ///< at least one; the first stands for the figure
  std::vector<FigurePanel> panels;    ///< at least one
  std::optional<Diagram> drawing;     ///< in place of numbers and panels
};

}  // namespace reckon::bench
