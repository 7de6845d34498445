// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A logarithmic axis of a picture: from values to pixels, and where its ticks are.
#pragma once

#include <span>
#include <vector>

namespace reckon::bench {

/// Values > 0 from `low` to `high` on the pixels from `begin` to `finish`.
struct LogAxis {
  double low, high;
  double begin, finish;

  /// Of values outside: the end of the axis.
  [[nodiscard]] double at(double value) const;
  /// 1, 2 and 5 times the powers of ten, or the powers alone where these are many.
  [[nodiscard]] std::vector<double> ticks() const;
};

/// From the least of the values above `floor` to the greatest, with a margin; a decade at least.
[[nodiscard]] LogAxis log_axis_over(std::span<const double> values, double floor, double begin,
                                    double finish);

}  // namespace reckon::bench
