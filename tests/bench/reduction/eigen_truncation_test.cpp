// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/eigen_truncation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reckon/bench/reduction/balanced_reduction.hpp"
#include "reckon/tests/bench/support/linear_systems.hpp"

namespace reckon::bench {
namespace {

using Eigen::MatrixXd;
using test::cascade;
using test::largest_difference;
using test::oscillator;

TEST(EigenTruncation, IsCorrectForSeparatePoles) {
  std::mt19937 random(2);
  for (int round = 0; round < 50; ++round) {
    const StateSpace system = test::random_stable(random, 2 + round % 10);
    const ModalDecomposition all =
        truncated_by_eigenvectors(system, static_cast<int>(system.order()), Dropped::forgotten);
    EXPECT_LE(largest_difference(system, all.system, 1e-2, 1e5, 1.3),
              1e-9 * system.C.norm() * system.B.norm());
    const auto at_rest = truncated_by_eigenvectors(system, 2, Dropped::at_rest).system;
    const double gain = evaluate(system, 0.0)(0, 0).real();
    EXPECT_NEAR(evaluate(at_rest, 0.0)(0, 0).real(), gain, 1e-9 * (1 + std::abs(gain)));
  }
}

// Each gain is 1: an error of 1e4 is a force 1e4 times too large.
TEST(EigenTruncation, ErrsWithoutBoundForCoincidentPoles) {
  struct Case {
    const char* name;
    StateSpace system;
    int kept;
    double at_least;
  };
  for (const Case& one : {Case{"damping ratio 1 + 1e-9", oscillator(1.0 + 1e-9), 1, 1e4},
                          Case{"critical damping", oscillator(1.0), 1, 1e7},
                          Case{"4 lags 1e-3 apart", cascade(4, 20, 1e-3), 2, 1e4},
                          Case{"8 lags 1e-3 apart", cascade(8, 20, 1e-3), 3, 1e10},
                          Case{"8 equal lags", cascade(8, 20, 0), 3, 1e12}}) {
    const ModalDecomposition lost =
        truncated_by_eigenvectors(one.system, one.kept, Dropped::forgotten);
    const double theirs = largest_difference(one.system, lost.system, 1e-3, 1e4);
    const BalancedReduction reduction(one.system);
    const double ours = largest_difference(one.system, reduction.model(one.kept), 1e-3, 1e4);
    EXPECT_GE(theirs, one.at_least) << one.name;
    EXPECT_LE(ours, reduction.bound(one.kept) * (1 + 1e-6)) << one.name;
    EXPECT_LE(ours, 0.25) << one.name;
    std::printf("%-24s eigenvectors %.1e (condition %.1e), balanced %.3f\n", one.name, theirs,
                lost.condition, ours);
  }
}

// A mass with a drag of 1e-6 1/s: 1/(s (s + 1e-6)) is 1e6/s less 1e6/(s + 1e-6). With only one of
// the two terms the body is not pushed but thrown.
TEST(EigenTruncation, GivesAFreeBodySpuriousResidues) {
  StateSpace body = test::oscillator(0.5e-6);
  body.A(1, 0) = 0.0;
  const ModalDecomposition thrown = truncated_by_eigenvectors(body, 1, Dropped::forgotten);
  EXPECT_GE(thrown.condition, 1e6);
  EXPECT_NEAR(largest_difference(body, thrown.system, 1.0, 10.0), 1e6, 1e3);
  const BalancedReduction reduction(body);
  EXPECT_EQ(reduction.least_order(), 2);
  EXPECT_LE(largest_difference(body, reduction.model(2), 1e-2, 10.0), 1e-8);
}

TEST(ModalDecomposition, KeepsTheResponseWithOrWithoutEigenvectors) {
  for (const StateSpace& system :
       {oscillator(0.3), oscillator(2.0), oscillator(1.0), oscillator(1.0 + 1e-3),
        oscillator(1.0 + 1e-13), cascade(3, 20, 0.2), cascade(8, 20, 0), cascade(8, 20, 1e-3)}) {
    const ModalDecomposition parts = decomposed(system);
    EXPECT_LE(largest_difference(system, parts.system, 1e-3, 1e4), 1e-9);
    EXPECT_EQ(parts.by_eigenvectors, parts.condition <= kMostCondition);
  }
  EXPECT_FALSE(decomposed(oscillator(1.0)).by_eigenvectors);
  EXPECT_TRUE(decomposed(oscillator(2.0)).by_eigenvectors);
  EXPECT_NEAR(decomposed(oscillator(0.3)).system.A(0, 1), std::sqrt(1 - 0.09), 1e-12);
}

}  // namespace
}  // namespace reckon::bench
