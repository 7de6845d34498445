// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A curve above zero in the characters of a terminal: eight dots a character in Braille if the
// terminal has UTF-8, else ASCII.
#pragma once

#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Size of the plot, and its characters.
struct PlotCanvas {
  std::size_t width = 80;  ///< columns of the terminal, labels included; at least 24
  std::size_t height = 6;  ///< rows of the curve
  bool braille = false;
};

/// The canvas of an output. Its width comes from COLUMNS or the terminal, else it is 80. Braille is
/// used on a terminal with a UTF-8 locale (LC_ALL, LC_CTYPE, LANG).
[[nodiscard]] PlotCanvas canvas_of(std::FILE* out);

/// Labels of the axes.
struct PlotLabels {
  std::string_view unit;  ///< of the values: "N"
  double end = 0;         ///< of the time axis, which begins at 0 [s]
};

/// The area below `values`, which are evenly spaced over the time. A column shows its greatest
/// value. NaN and values below 0 count as 0. Lines end in '\n'.
[[nodiscard]] std::string terminal_plot(std::span<const float> values, const PlotLabels& labels,
                                        const PlotCanvas& canvas);

}  // namespace reckon::tools
