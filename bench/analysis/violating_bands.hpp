// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Frequencies at which a condition that is known point by point does not hold. Off-line code.
#pragma once

#include <functional>
#include <vector>

namespace reckon::bench {

struct Band {
  double low = 0.0, high = 0.0;
};

/// Bands of [low, high] in which margin(x) < 0, lowest first: a geometric grid, then the edges are
/// bisected to 1e-12. A band narrower than the grid may be missed; judge_positive_real() misses
/// none.
/// @param low > 0  @param high > low  @param points of the grid, >= 2
/// @throws std::invalid_argument where the range is none, or a margin is not a number
[[nodiscard]] std::vector<Band> violating_bands(const std::function<double(double)>& margin,
                                                double low, double high, int points);

}  // namespace reckon::bench
