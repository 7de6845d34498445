// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One input, one output: a quotient of two real polynomials in s or z. Off-line code.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// numerator / denominator, coefficients with the highest power first: {1, -0.5} is z - 0.5.
///
///     const TransferFunction spring{{K * T, 0}, {1, -1}, T};             // K T z / (z - 1)
struct TransferFunction {
  std::vector<double> numerator, denominator;
  double sample_period = 0.0;  ///< [s]; 0: in s, else in z
};

/// The same function without leading zeros, with a leading coefficient of 1 in the denominator.
/// @throws std::invalid_argument if a coefficient is not finite, the denominator is zero or the
/// sample period is not a number >= 0
[[nodiscard]] TransferFunction checked(TransferFunction h);

/// Value at s or z by Horner's rule. Not finite at a pole.
[[nodiscard]] std::complex<double> evaluate(const TransferFunction& h, std::complex<double> point);

/// Roots of a polynomial, highest power first: eigenvalues of its companion matrix (Eigen); roots
/// at 0 exactly. Empty for a constant. @throws std::invalid_argument for the zero polynomial
[[nodiscard]] Eigen::VectorXcd roots(const std::vector<double>& polynomial);
/// Roots of the denominator; common factors are not cancelled (nor for zeros).
[[nodiscard]] Eigen::VectorXcd poles(const TransferFunction& h);
/// Roots of the numerator. @throws std::invalid_argument if h is 0
[[nodiscard]] Eigen::VectorXcd zeros(const TransferFunction& h);

/// Controllable companion form; minimal if numerator and denominator are coprime.
/// @throws std::invalid_argument if the numerator's degree is above the denominator's: such a
/// system has no state form (a mass as an impedance: use its admittance)
[[nodiscard]] StateSpace to_state_space(const TransferFunction& h);

/// a + b. One denominator if both are equal to the last bit, else their product: a common pole then
/// counts twice, which parallel() of state spaces avoids.
/// @throws std::invalid_argument if sample periods differ (also for the product)
[[nodiscard]] TransferFunction sum(const TransferFunction& a, const TransferFunction& b);
[[nodiscard]] TransferFunction product(const TransferFunction& a, const TransferFunction& b);
[[nodiscard]] TransferFunction scaled(TransferFunction h, double factor);
/// 1 / h. @throws std::invalid_argument if h is 0
[[nodiscard]] TransferFunction inverse(const TransferFunction& h);
/// h z^-samples. @throws std::invalid_argument if h is in s, or samples < 0
[[nodiscard]] TransferFunction delayed(const TransferFunction& h, int samples);

}  // namespace reckon::bench
