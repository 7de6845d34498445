// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A figure as SVG, CSV and JSON, all of them as one page.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "reckon/bench/studies/figures/figure_list.hpp"

namespace reckon::bench {

/// A figure that was made.
struct MadeFigure {
  const FigureKind* kind;  ///< of figure_kinds()
  Figure figure;
};

/// "figure_3.5.svg".
[[nodiscard]] std::string figure_file(std::string_view name, std::string_view extension);

/// "0.4 N".
[[nodiscard]] std::string number_with_unit(double number, std::string_view unit);

/// The whole picture, legible alone.
[[nodiscard]] std::string figure_svg(const MadeFigure& made);

/// A line of names, then one for each point: panel, curve, and the two values under the titles of
/// the first panel's axes, with all their digits. Not of drawings.
[[nodiscard]] std::string figure_csv(const MadeFigure& made);

/// One object and an end of line: name, title, drawing, ours, thesis (null where it prints no
/// number), unit, what, numbers, said, why. Of a drawing ours, thesis, unit and what are null.
[[nodiscard]] std::string figure_json(const MadeFigure& made);

/// A page that needs no other file; it links to the CSV and SVG beside it.
[[nodiscard]] std::string figures_page(std::span<const MadeFigure> figures);

}  // namespace reckon::bench
