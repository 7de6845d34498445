// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/state_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

MatrixXd scalar(double value) { return MatrixXd::Constant(1, 1, value); }

MatrixXd random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

StateSpace random_system(std::mt19937& random, Eigen::Index order, Eigen::Index ports,
                         double sample_period) {
  return {random_matrix(random, order, order), random_matrix(random, order, ports),
          random_matrix(random, ports, order), random_matrix(random, ports, ports), sample_period};
}

// 1 / (m s + b), force to speed.
StateSpace device(double m, double b) {
  return {scalar(-b / m), scalar(1 / m), scalar(1), scalar(0)};
}

TEST(StateSpace, FirstOrderDeviceIsItsClosedForm) {
  const Complex s = border_point(0, 7.0);
  EXPECT_NEAR(std::abs(evaluate(device(2, 0.5), s)(0, 0) - 1.0 / (2.0 * s + 0.5)), 0, 1e-15);
}

TEST(StateSpace, HeldInputOnADeviceIsTheExponential) {
  const double m = 0.1, b = 0.3, T = 0.01, a = std::exp(-b * T / m);
  const StateSpace sampled = discretise_zero_order_hold(device(m, b), T);
  EXPECT_NEAR(sampled.A(0, 0), a, 1e-14);
  EXPECT_NEAR(sampled.B(0, 0), (1 - a) / b, 1e-13);
}

TEST(StateSpace, HeldForceMovesAFreeMassParabolically) {
  // A is singular: a formula with its inverse would fail.
  MatrixXd A(2, 2), B(2, 1), C(1, 2);
  A << 0, 1, 0, 0;
  B << 0, 0.5;
  C << 1, 0;
  const StateSpace sampled = discretise_zero_order_hold({A, B, C, scalar(0)}, 0.2);
  EXPECT_NEAR(sampled.B(0, 0), 0.5 * 0.2 * 0.2 / 2, 1e-16);
  EXPECT_NEAR(sampled.B(1, 0), 0.5 * 0.2, 1e-16);
}

TEST(StateSpace, SchurResponseEqualsTheLuResponse) {
  std::mt19937 random(1);
  for (const Eigen::Index order : {0, 1, 2, 5, 12}) {
    const StateSpace system = random_system(random, order, 2, 1e-3);
    const FrequencyResponse response(system);
    for (const double w : {0.1, 100.0, 3000.0}) {
      const Eigen::MatrixXcd lu = evaluate(system, border_point(1e-3, w));
      EXPECT_LT((response.at_frequency(w) - lu).norm(), 1e-11 * (1 + lu.norm()));
    }
  }
}

TEST(StateSpace, ConnectionsAreTheAlgebraOfResponses) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const StateSpace f = random_system(random, i % 4, 2, 1e-3);
    const StateSpace h = random_system(random, i % 3, 2, 1e-3);
    const Complex z = std::polar(1.5, 0.1 * i);
    const Eigen::MatrixXcd F = evaluate(f, z), H = evaluate(h, z);
    const Eigen::MatrixXcd I = Eigen::MatrixXcd::Identity(2, 2);
    EXPECT_LT((evaluate(series(f, h), z) - H * F).norm(), 1e-9 * (1 + F.norm() * H.norm()));
    EXPECT_LT((evaluate(parallel(f, h), z) - F - H).norm(), 1e-10 * (1 + F.norm() + H.norm()));
    const Eigen::MatrixXcd closed = evaluate(feedback(f, h), z);
    EXPECT_LT(((I + F * H) * closed - F).norm(), 1e-8 * (1 + F.norm()) * (1 + H.norm())) << i;
  }
}

TEST(StateSpace, DelayIsAPowerOfZ) {
  const Complex z = std::polar(1.0, 0.3);
  for (const int samples : {0, 1, 5}) {
    const Eigen::MatrixXcd line = evaluate(sample_delay(samples, 2, 1e-3), z);
    const Eigen::MatrixXcd power = std::pow(z, -samples) * Eigen::MatrixXcd::Identity(2, 2);
    EXPECT_LT((line - power).norm(), 1e-14);
  }
}

TEST(StateSpace, BadModelsAreRefused) {
  StateSpace odd = device(1, 1);
  odd.B = MatrixXd::Zero(2, 1);
  EXPECT_THROW((void)checked(odd), std::invalid_argument);
  StateSpace not_finite = device(1, 1);
  not_finite.C(0, 0) = std::nan("");
  EXPECT_THROW((void)checked(not_finite), std::invalid_argument);
  EXPECT_THROW((void)discretise_zero_order_hold(device(1, 1), 0), std::invalid_argument);
  EXPECT_THROW((void)series(device(1, 1), sample_delay(1, 1, 1e-3)), std::invalid_argument);
  EXPECT_THROW((void)feedback(static_gain(scalar(1), 0), static_gain(scalar(-1), 0)),
               std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench
