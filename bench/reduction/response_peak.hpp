// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Greatest value of a function of frequency that is smooth between known places.
#pragma once

#include <functional>
#include <limits>
#include <vector>

namespace reckon::bench {

struct ResponsePeak {
  double value = 0.0;
  double angular_frequency = 0.0;  ///< [rad/s]
};

/// Evaluates a grid, then searches by golden section around each local maximum that may be the
/// greatest, to 1e-6 of the frequency.
/// @param of >= 0, of an angular frequency [rad/s]
/// @param grid > 0, any order, dense around each resonance: near_resonance()
/// @param enough the first value of the grid above it ends the search and is returned
[[nodiscard]] ResponsePeak response_peak(const std::function<double(double)>& of,
                                         std::vector<double> grid,
                                         double enough = std::numeric_limits<double>::infinity());

/// `count` frequencies in steps of equal ratio. @param lowest > 0  @param highest > lowest [rad/s]
[[nodiscard]] std::vector<double> frequency_grid(double lowest, double highest, int count);

/// Adds frequencies for a resonance: at it, and at some half-widths on both sides.
/// @param half_width [rad/s], > 0
void near_resonance(double angular_frequency, double half_width, std::vector<double>& grid);

}  // namespace reckon::bench
