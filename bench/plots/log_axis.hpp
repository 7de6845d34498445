// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Logarithmic axes of a picture: conversion from values to pixels, ticks and grid.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// Maps values > 0 from `low` to `high` to the pixels from `begin` to `finish`.
struct LogAxis {
  double low, high;
  double begin, finish;

  /// Values outside give the end of the axis.
  [[nodiscard]] double at(double value) const;
  /// 1, 2 and 5 times the powers of ten; only the powers if there are many, and more ticks between
  /// them if there are fewer than three.
  [[nodiscard]] std::vector<double> ticks() const;
};

/// From the least of the values above `floor` to the greatest, with a margin; at least `decades`
/// long.
[[nodiscard]] LogAxis log_axis_over(std::span<const double> values, double floor, double begin,
                                    double finish, double decades);

/// One of the two axes with its labels.
struct LogScale {
  LogAxis axis;
  std::string_view title;
  std::string (*text)(double tick);
};

/// Appends grid, ticks, axes and their titles as elements of a picture; `y` begins at the bottom.
/// Classes: as in tools::svg_picture().
void append_log_grid(std::string& out, const LogScale& x, const LogScale& y);

}  // namespace reckon::bench
