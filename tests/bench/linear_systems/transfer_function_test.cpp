// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/transfer_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "reckon/bench/analysis/virtual_environment.hpp"

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;

TEST(TransferFunction, RootsOfAProductOfFactorsAreFound) {
  // (x + 2)(x - 3)(x^2 + 2x + 5) x^2
  const Eigen::VectorXcd found = roots({1, 1, -3, -17, -30, 0, 0});
  for (const Complex want :
       {Complex(-2, 0), Complex(3, 0), Complex(-1, 2), Complex(-1, -2), Complex(0, 0)}) {
    EXPECT_LT((found.array() - want).abs().minCoeff(), 1e-12) << want;
  }
  EXPECT_EQ(found.size(), 6);
}

TEST(TransferFunction, StateFormHasTheSameResponse) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const auto degree = static_cast<std::size_t>(i % 6);
    TransferFunction h{std::vector<double>(degree + 1), std::vector<double>(degree + 1), 0.01};
    for (double& c : h.numerator) c = normal(random);
    for (double& c : h.denominator) c = normal(random);
    const Complex z = std::polar(3.0, normal(random));
    const Complex direct = evaluate(h, z);
    EXPECT_LT(std::abs(evaluate(to_state_space(h), z)(0, 0) - direct),
              1e-9 * (1 + std::abs(direct)))
        << i;
  }
}

TEST(TransferFunction, ArithmeticEqualsTheArithmeticOfValues) {
  const TransferFunction a{{2, 1}, {1, -0.5}, 0.1}, b{{1}, {1, 0.2, 0.3}, 0.1};
  const Complex z(0.3, 1.1), A = evaluate(a, z), B = evaluate(b, z);
  EXPECT_LT(std::abs(evaluate(sum(a, b), z) - A - B), 1e-14);
  EXPECT_LT(std::abs(evaluate(product(a, b), z) - A * B), 1e-14);
  EXPECT_LT(std::abs(evaluate(inverse(a), z) * A - 1.0), 1e-14);
  EXPECT_LT(std::abs(evaluate(delayed(a, 3), z) - A / (z * z * z)), 1e-14);
  EXPECT_EQ(sum(a, a).denominator.size(), 2u) << "an equal denominator is kept";
}

TEST(TransferFunction, ImproperNonFiniteAndEmptyOnesAreRefused) {
  EXPECT_THROW((void)to_state_space({{1, 0}, {1}, 0}), std::invalid_argument);
  EXPECT_THROW((void)checked({{std::nan("")}, {1}, 0}), std::invalid_argument);
  EXPECT_THROW((void)checked({{1}, {0, 0}, 0}), std::invalid_argument);
  EXPECT_THROW((void)checked({{1}, {1}, -1}), std::invalid_argument);
  EXPECT_THROW((void)delayed({{1}, {1, 1}, 0}, 1), std::invalid_argument);
  EXPECT_THROW((void)sum({{1}, {1}, 0.1}, {{1}, {1}, 0.2}), std::invalid_argument);
  EXPECT_THROW((void)zeros({{0}, {1}, 0}), std::invalid_argument);
}

// Coefficients of the thesis' environments, expanded by hand.
TEST(VirtualEnvironment, WallHasBothReadings) {
  const double K = 0.2, b_e = 0.1, T = 0.01;
  const TransferFunction with = virtual_wall(K, b_e, T, SpringReading::with_period);
  EXPECT_EQ(with.numerator, (std::vector<double>{b_e + K * T, -b_e}));
  EXPECT_EQ(with.denominator, (std::vector<double>{1, -1}));
  const TransferFunction without = virtual_wall(K, b_e, T, SpringReading::without_period);
  EXPECT_EQ(without.numerator, (std::vector<double>{b_e + K, -b_e}));
}

TEST(VirtualEnvironment, PositionFormIsSpringAndBackwardDifference) {
  const double K = 300, b_e = 2, T = 1e-3;
  const Complex z = std::polar(1.0, 0.4);
  const TransferFunction H = position_form(virtual_wall(K, b_e, T, SpringReading::with_period));
  EXPECT_LT(std::abs(evaluate(H, z) - (K + b_e * (z - 1.0) / (T * z))), 1e-9);
  const TransferFunction back = velocity_form(H);
  EXPECT_LT(std::abs(evaluate(back, z) - (b_e + K * T * z / (z - 1.0))), 1e-12);
}

TEST(VirtualEnvironment, TwoPoleReductionKeepsTheStaticGain) {
  // Next to the pole a = 1, which is the integrator: (z - a) VE at z = 1.
  const double K = 0.2, a = 1.0, alpha = 0.6, T = 0.01;
  const Complex z(1.0, 1e-9);
  const Complex ratio = evaluate(one_pole_environment(K, a, alpha, T), z) /
                        evaluate(two_pole_environment(K, a, alpha, T), z);
  EXPECT_NEAR(std::abs(ratio), 1.0, 1e-8);
  // With a pole that is not 1 both static gains are finite and equal.
  const double simple = evaluate(one_pole_environment(K, 0.9, alpha, T), 1.0).real();
  EXPECT_NEAR(simple, evaluate(two_pole_environment(K, 0.9, alpha, T), 1.0).real(), 1e-12 * simple);
}

TEST(VirtualEnvironment, PrintedHoldHasTheTruePhaseOnly) {
  for (const double theta : {0.0, 0.1, 1.0, 3.0}) {
    const Complex printed = printed_hold(theta), exact = zero_order_hold(theta);
    EXPECT_NEAR(std::arg(printed), std::arg(exact), 1e-14);
    EXPECT_LE(std::abs(printed), std::abs(exact) + 1e-15);
  }
  EXPECT_NEAR(std::abs(printed_hold(M_PI)), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(zero_order_hold(M_PI)), 2 / M_PI, 1e-15);
}

TEST(VirtualEnvironment, BackwardDifferenceDeviceIsAlwaysPositiveReal) {
  // (4.2) reduces to m + b T >= m cos w: it holds for every b >= 0 and so proves nothing.
  for (const double b : {0.0, 0.3, 5.0}) {
    const TransferFunction device = backward_difference_device(1.0, b, 1.0, 0.01);
    for (double w = 0.01; w < M_PI; w += 0.01) {
      EXPECT_GE(evaluate(device, std::polar(1.0, w)).real(), -1e-15);
    }
  }
}

}  // namespace
}  // namespace reckon::bench
