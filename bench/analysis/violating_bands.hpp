// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the frequency bands in which a condition is violated, by evaluating it at points. Off-line
// code.
#pragma once

#include <functional>
#include <vector>

namespace reckon::bench {

struct Band {
  double low = 0.0, high = 0.0;
};

/// Bands of [low, high] in which margin(x) < 0, lowest first: evaluates a geometric grid and
/// bisects the edges to 1e-12. It may miss a band narrower than the grid; judge_positive_real()
/// misses none.
/// @param low > 0 @param high > low @param points of the grid, >= 2
/// @throws std::invalid_argument if the range is empty, or a margin is NaN
[[nodiscard]] std::vector<Band> violating_bands(const std::function<double(double)>& margin,
                                                double low, double high, int points);

}  // namespace reckon::bench
