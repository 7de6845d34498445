// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Logarithmic axes of a picture: from values to pixels, where their ticks are, and their grid.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// Values > 0 from `low` to `high` on the pixels from `begin` to `finish`.
struct LogAxis {
  double low, high;
  double begin, finish;

  /// Of values outside: the end of the axis.
  [[nodiscard]] double at(double value) const;
  /// 1, 2 and 5 times the powers of ten; the powers alone where these are many, more between them
  /// where these would be fewer than three.
  [[nodiscard]] std::vector<double> ticks() const;
};

/// From the least of the values above `floor` to the greatest, with a margin; `decades` long at
/// least.
[[nodiscard]] LogAxis log_axis_over(std::span<const double> values, double floor, double begin,
                                    double finish, double decades);

/// One of both axes with the words at it.
struct LogScale {
  LogAxis axis;
  std::string_view title;
  std::string (*text)(double tick);
};

/// Grid, ticks, axes and their titles as elements of a picture; `y` begins at the bottom. Classes:
/// those of tools::svg_picture().
void append_log_grid(std::string& out, const LogScale& x, const LogScale& y);

}  // namespace reckon::bench
