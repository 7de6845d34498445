// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A curve above zero in the characters of a terminal: eight dots a character in Braille where UTF-8
// is understood, else ASCII.
#pragma once

#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace reckon::tools {

/// How large the plot may be, and in which letters.
struct PlotCanvas {
  std::size_t width = 80;  ///< columns of the terminal, labels included; at least 24 are used
  std::size_t height = 6;  ///< rows of the curve
  bool braille = false;
};

/// The canvas of an output: its width by COLUMNS or by the terminal, else 80; Braille where it is a
/// terminal and the locale (LC_ALL, LC_CTYPE, LANG) is UTF-8.
[[nodiscard]] PlotCanvas canvas_of(std::FILE* out);

/// What stands at the axes.
struct PlotLabels {
  std::string_view unit;  ///< of the values: "N"
  double end = 0;         ///< of the time axis, which begins at 0 [s]
};

/// The area below `values`, evenly spaced over the time; what lies between two columns keeps its
/// greatest. Values that are not numbers or below 0 count as 0. Lines end in '\n'.
[[nodiscard]] std::string terminal_plot(std::span<const float> values, const PlotLabels& labels,
                                        const PlotCanvas& canvas);

}  // namespace reckon::tools
