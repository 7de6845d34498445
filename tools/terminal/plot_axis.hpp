// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Round numbers along an axis, for the plots of the terminal and of SVG files.
#pragma once

#include <cmath>
#include <initializer_list>

namespace reckon::tools {

/// The greatest of 1, 2, 5 times a power of ten that divides `span` into at least `parts` steps, or
/// at most 2.5 times as many. 1 if span is not a positive finite number.
[[nodiscard]] inline double round_step(double span, double parts) {
  if (!std::isfinite(span) || !(span > 0)) return 1;
  const double raw = span / parts;
  const double decade = std::pow(10.0, std::floor(std::log10(raw) + 1e-9));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= raw * (1 + 1e-9)) return factor * decade;
  return decade;
}

/// The end of an axis from 0 that includes `greatest`: a multiple of a round step, 1 for zero.
[[nodiscard]] inline double round_end(double greatest, double parts) {
  if (!std::isfinite(greatest) || !(greatest > 0)) return 1;
  const double step = round_step(greatest, parts);
  return step * std::ceil(greatest / step - 1e-9);
}

}  // namespace reckon::tools
