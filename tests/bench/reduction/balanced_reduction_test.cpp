// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/balanced_reduction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "reckon/bench/reduction/block_schur.hpp"
#include "reckon/tests/bench/support/linear_systems.hpp"
#include "reckon/tests/bench/support/membranes.hpp"

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using test::cascade;
using test::largest_difference;
using test::oscillator;

double static_gain_of(const StateSpace& system) { return evaluate(system, 0.0)(0, 0).real(); }

TEST(BlockSchur, PutsSlowOrUnstablePolesInFront) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    const Index n = 2 + round % 14;
    const MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    const BlockSchur split = split_spectrum(A, -0.2);
    EXPECT_LE((split.Q.transpose() * split.Q - MatrixXd::Identity(n, n)).norm(),
              1e-13 * static_cast<double>(n));
    EXPECT_LE((split.Q * split.T * split.Q.transpose() - A).norm(), 1e-12 * A.norm());
    const Index k = split.leading;
    if (k > 0) {
      EXPECT_GE(MatrixXd(split.T.topLeftCorner(k, k)).eigenvalues().real().minCoeff(), -0.2 - 1e-9);
    }
    if (k < n) {
      EXPECT_LT(MatrixXd(split.T.bottomRightCorner(n - k, n - k)).eigenvalues().real().maxCoeff(),
                -0.2 + 1e-9);
    }
  }
}

TEST(BlockSchur, GramiansAndSylvesterSolveTheirEquations) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  const auto filled = [&](Index rows, Index columns) {
    return MatrixXd(MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
  };
  for (int round = 0; round < 50; ++round) {
    const StateSpace system = test::random_stable(random, 1 + round % 12);
    const auto [P, Q] = gramians(system);
    const MatrixXd& A = system.A;
    const MatrixXd BB = system.B * system.B.transpose(), CC = system.C.transpose() * system.C;
    EXPECT_LE((A * P + P * A.transpose() + BB).norm(), 1e-10 * (A.norm() * P.norm()));
    EXPECT_LE((A.transpose() * Q + Q * A + CC).norm(), 1e-10 * (A.norm() * Q.norm()));
    const MatrixXd other = filled(4, 4) + 100.0 * A.norm() * MatrixXd::Identity(4, 4);
    const MatrixXd F = filled(system.order(), 4);
    const MatrixXd X = solve_sylvester(A, other, F);
    EXPECT_LE((A * X - X * other - F).norm(), 1e-10 * F.norm());
  }
  EXPECT_THROW((void)gramians(oscillator(0.0)), std::runtime_error);
  EXPECT_THROW((void)solve_sylvester(oscillator(1.0).A, oscillator(1.0).A, filled(2, 2)),
               std::runtime_error);
}

// Two equal poles do not have two eigenvectors; the Hankel values are (sqrt(2) +- 1)/4.
TEST(BalancedReduction, CriticallyDampedPairIsItsClosedForm) {
  const BalancedReduction reduction(oscillator(1.0));
  EXPECT_NEAR(reduction.hankel_values()[0], (std::sqrt(2.0) + 1.0) / 4.0, 1e-9);
  EXPECT_NEAR(reduction.hankel_values()[1], (std::sqrt(2.0) - 1.0) / 4.0, 1e-9);
  EXPECT_NEAR(reduction.bound(1), (std::sqrt(2.0) - 1.0) / 2.0, 1e-9);
  // With one omitted state the error reaches the bound at once: the direct term is -bound.
  EXPECT_NEAR(reduction.model(1).D(0, 0), -(std::sqrt(2.0) - 1.0) / 2.0, 1e-8);
  EXPECT_NEAR(static_gain_of(reduction.model(1)), 1.0, 1e-12);
  EXPECT_LE(largest_difference(oscillator(1.0), reduction.model(2), 1e-3, 1e3), 1e-9);
}

TEST(BalancedReduction, StaysWithinItsBoundForCoincidentPoles) {
  for (const StateSpace& system :
       {oscillator(1.0), oscillator(1.0 + 1e-9), oscillator(1.0 - 1e-9), oscillator(0.01),
        cascade(2, 20, 0), cascade(4, 20, 1e-7), cascade(8, 20, 0), cascade(8, 20, 1e-3),
        test::pressed(test::make_chain(12, 0.02, 900, 100, 1, 1e-3), 900)}) {
    const BalancedReduction reduction(system);
    const double gain = static_gain_of(system);
    for (int order = reduction.least_order(); order <= reduction.most_order(); ++order) {
      const StateSpace model = reduction.model(order);
      EXPECT_EQ(model.order(), order);
      const double size = reduction.hankel_values()[0];
      EXPECT_LE(largest_difference(system, model, 1e-3, 1e5), reduction.bound(order) + 1e-7 * size);
      EXPECT_LE(largest_difference(system, reduction.truncated(order), 1e-3, 1e5),
                reduction.bound(order) + 1e-7 * size);
      EXPECT_NEAR(static_gain_of(model), gain, 1e-9 * std::abs(gain));
    }
  }
}

TEST(BalancedReduction, StaysWithinItsBoundForRandomSystems) {
  std::mt19937 random(8);
  for (int round = 0; round < 100; ++round) {
    const StateSpace system = test::random_stable(random, 2 + round % 15);
    const BalancedReduction reduction(system);
    for (int order = 0; order <= reduction.most_order(); order += 2) {
      const StateSpace model = reduction.model(order);
      if (order > 0) {
        EXPECT_LT(poles(model).real().maxCoeff(), 0.0);
      }
      EXPECT_LE(largest_difference(system, model, 1e-1, 1e6, 1.2),
                reduction.bound(order) * (1 + 1e-7) + 1e-7 * reduction.hankel_values()[0]);
    }
  }
}

// Pushed freely, beside an oscillating part: the double integrator is unchanged.
TEST(BalancedReduction, KeepsFreeAndUnstableMotions) {
  const auto body = test::make_chain(10, 0.02, 900, 0, 0, 2e-3);
  StateSpace system = test::pressed(body, 0.0);
  system.B.bottomRows(10) = MatrixXd(body.M).inverse() * body.B;
  system.C.leftCols(10) = body.B.transpose();
  const BalancedReduction reduction(system);
  EXPECT_EQ(reduction.least_order(), 2);
  const double size = reduction.hankel_values()[0];
  for (int order = 2; order <= reduction.most_order(); ++order) {
    // The rest has a magnitude of 1 mm/N; the free motion at 0.1 rad/s has 500 m/N.
    EXPECT_LE(largest_difference(system, reduction.model(order), 0.1, 1e4),
              reduction.bound(order) + 1e-6 * size + 1e-8 * 500)
        << order;
  }

  // A buckled body: one spring is repulsive.
  StateSpace buckled = test::pressed(test::make_chain(8, 0.02, 900, 100, 1, 1e-3), 900);
  buckled.A(8, 0) += 15000.0;
  const double unstable = poles(buckled).real().maxCoeff();
  ASSERT_GT(unstable, 1.0);
  const BalancedReduction of_buckled(buckled);
  ASSERT_GE(of_buckled.least_order(), 1);
  for (int order = of_buckled.least_order(); order <= of_buckled.most_order(); ++order) {
    EXPECT_NEAR(poles(of_buckled.model(order)).real().maxCoeff(), unstable, 1e-6 * unstable);
    EXPECT_LE(largest_difference(buckled, of_buckled.model(order), 1e-2, 1e4),
              of_buckled.bound(order) + 1e-6 * of_buckled.hankel_values()[0]);
  }
}

// Thesis (4.21): K z/((z - a)(z - alpha)) becomes (K z/(1 - alpha))/(z - a).
TEST(BalancedReduction, ResidualisationIsTheExampleOfTheThesis) {
  for (const double a : {1.0, 0.9, 0.3}) {
    for (const double alpha : {0.0, 0.6, 0.95}) {
      const double K = 0.2;
      // z/(z - a), then K/(z - alpha).
      StateSpace full{MatrixXd(2, 2), MatrixXd(2, 1), MatrixXd(1, 2), MatrixXd::Zero(1, 1), 0.01};
      full.A << a, 0.0, a, alpha;
      full.B << 1.0, 1.0;
      full.C << 0.0, K;
      const StateSpace simple = residualised(full, 1);
      for (double angle = 0.05; angle < 3.1; angle += 0.1) {
        const std::complex<double> z = std::polar(1.0, angle);
        const auto complex_form = K * z / ((z - a) * (z - alpha));
        const auto simple_form = K * z / (1 - alpha) / (z - a);
        EXPECT_LE(std::abs(evaluate(full, z)(0, 0) - complex_form), 1e-12 * std::abs(complex_form));
        EXPECT_LE(std::abs(evaluate(simple, z)(0, 0) - simple_form), 1e-12 * std::abs(simple_form));
      }
      if (a < 1.0) {
        EXPECT_NEAR(evaluate(simple, 1.0)(0, 0).real(), evaluate(full, 1.0)(0, 0).real(), 1e-12);
      }
    }
  }
}

TEST(BalancedReduction, RefusesSystemsThatItCannotReduce) {
  StateSpace sampled = oscillator(0.5);
  sampled.sample_period = 1e-3;
  EXPECT_THROW(BalancedReduction{sampled}, std::invalid_argument);
  const BalancedReduction reduction(oscillator(0.5));
  EXPECT_THROW((void)reduction.model(3), std::invalid_argument);
  EXPECT_THROW((void)reduction.bound(-1), std::invalid_argument);
  // An integrator has no static equilibrium.
  StateSpace free = oscillator(0.5);
  free.A(1, 0) = 0.0;
  EXPECT_THROW((void)residualised(free, 0), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench
