// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Greatest value of a function of one variable in an interval.
#pragma once

namespace reckon::bench {

struct Greatest {
  double value;
  double at;
};

/// By golden section. Correct if `of` rises to one maximum between `low` and `high` and falls after
/// it; otherwise some value of the function there. 5 calls of `of` for each factor of ten.
/// @param high > low  @param precision width of the final interval, well above the rounding of
/// `low` and `high`
template <typename Of>
[[nodiscard]] Greatest greatest_between(double low, double high, double precision, Of&& of) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = of(a), at_b = of(b);
  while (high - low > precision) {
    if (at_a >= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = of(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = of(b);
    }
  }
  return at_a > at_b ? Greatest{at_a, a} : Greatest{at_b, b};
}

}  // namespace reckon::bench
