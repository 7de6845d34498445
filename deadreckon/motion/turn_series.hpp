// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The terms of R1, R2 and exp(r/2) as power series in |r|^2, for extrapolation.
// Formulas: docs/dead_reckoning.md.
#pragma once

#include <array>
#include <cstddef>

namespace reckon::deadreckon {

// The series in (w t)^2 are used below this angle [rad], where kSeriesTerms leave an error of
// 1e-17.
inline constexpr double kSeriesAngle = 1.0;
inline constexpr std::size_t kSeriesTerms = 9;
using Series = std::array<double, kSeriesTerms>;

// Coefficients (-1)^n numerator(n) / (2n + offset)! of the powers of (w t)^2.
constexpr Series series(std::size_t offset, std::size_t numerator_slope,
                        std::size_t numerator_start) {
  Series c{};
  double factorial = 1;
  std::size_t reached = 0;
  for (std::size_t n = 0; n < kSeriesTerms; ++n) {
    while (reached < 2 * n + offset) factorial *= static_cast<double>(++reached);
    const auto numerator = static_cast<double>(numerator_slope * n + numerator_start);
    c[n] = (n % 2 == 0 ? 1.0 : -1.0) * numerator / factorial;
  }
  return c;
}

inline constexpr Series kSineOver = series(1, 0, 1);       // sin x / x
inline constexpr Series kCosine = series(0, 0, 1);         // cos x
inline constexpr Series kVelocityTwice = series(3, 0, 1);  // (x - sin x) / x^3
inline constexpr Series kPositionTwice = series(4, 2, 3);  // (x^2/2 - cos x - x sin x + 1) / x^4

[[gnu::always_inline]] inline constexpr double sum(const Series& c, double square) {
  double total = c[kSeriesTerms - 1];
  for (std::size_t n = kSeriesTerms - 1; n-- > 0;) total = total * square + c[n];
  return total;
}

// With u = |r|, r = w t: R1 v = t (f1 v + h1 r x v + g1 r (r.v)) and R2 a = t^2 (f2 a + h2 r x a +
// g2 r (r.a)); q = exp(r/2). There is no division by |w|, so that a zero rate needs no special
// case.
struct TurnTerms {
  double f1, h1, g1;
  double f2, h2, g2;
  double half_cosine, half_sine_over_angle;  // cos(u/2), sin(u/2)/u
};

/// `square` = |r|^2 < kSeriesAngle^2.
[[gnu::always_inline]] inline constexpr TurnTerms series_terms(double square) {
  const double quarter = 0.25 * square;
  const double cosine = sum(kCosine, quarter);
  const double sine_over = sum(kSineOver, quarter);  // sin(u/2) / (u/2)
  const double f1 = sine_over * cosine;              // sin u / u
  const double h1 = 0.5 * sine_over * sine_over;     // (1 - cos u) / u^2
  const double g1 = sum(kVelocityTwice, square);
  return {f1, h1, g1, f1 - h1, h1 - g1, sum(kPositionTwice, square), cosine, 0.5 * sine_over};
}

}  // namespace reckon::deadreckon
