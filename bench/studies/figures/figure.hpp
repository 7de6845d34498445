// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One figure of the thesis as data: its content, the claim of the thesis and our result; an
// experiment with numbers and curves, or a drawing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "reckon/bench/plots/diagram.hpp"

namespace reckon::bench {

struct FigureCurve {
  std::string name;
  std::vector<double> x, y;  ///< of equal length, in the units of the panel's axes
};

/// One pair of axes.
struct FigurePanel {
  std::string title;
  std::string across, value;  ///< titles of the axes, with units
  double end = 0;             ///< of the horizontal axis, which begins at 0; curves are cut there
  std::optional<std::array<double, 2>> range;  ///< of the vertical axis; curves are cut there
  std::vector<FigureCurve> curves;
};

/// A number that characterises the figure.
struct FigureNumber {
  std::string what;
  double ours = 0;               ///< finite
  std::optional<double> thesis;  ///< if the thesis prints one
  std::string unit;
};

struct Figure {
  std::string thesis;  ///< claim of the thesis, in one line
  /// Reason for a difference, or "not reproducible, because .."; for a drawing the counterpart in
  /// Reckon.
  std::string why;
  std::vector<FigureNumber> numbers;  ///< at least one; the first represents the figure
  std::vector<FigurePanel> panels;    ///< at least one
  std::optional<Diagram> drawing;     ///< instead of numbers and panels
};

}  // namespace reckon::bench
