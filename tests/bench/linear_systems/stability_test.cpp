// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reckon/bench/linear_systems/transfer_function.hpp"
#include "reckon/tests/bench/linear_systems/random_systems.hpp"

namespace reckon::bench::stability_test {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;

MatrixXd scalar(double value) { return MatrixXd::Constant(1, 1, value); }

// Jordan block of size 2 for p and, if p is not real, for its conjugate.
MatrixXd defective(Complex p) {
  const MatrixXd block = test::block_of(p);
  MatrixXd twice = test::joined(block, block);
  twice.topRightCorner(block.rows(), block.cols()).setIdentity();
  return twice;
}

enum class Kind { inside, simple, two_apart, defective, side_by_side, beyond, kCount };

struct Known {
  MatrixXd A;
  Stability verdict;
  double margin;
};

Complex random_inside(test::Random& random, bool sampled) {
  const Complex p = std::polar(test::uniform(random, 0.0, 0.99), test::uniform(random, 0, M_PI));
  return sampled ? p : (p - 1.0) / (p + 1.0);  // the half-plane
}

Complex random_on_border(test::Random& random, bool sampled) {
  const double angle =
      test::uniform(random, 0.0, 1.0) < 0.2 ? 0.0 : test::uniform(random, 0.1, 2.5);
  return sampled ? std::polar(1.0, angle) : Complex(0, std::tan(0.5 * angle));
}

double inside_by(Complex p, bool sampled) { return sampled ? 1 - std::abs(p) : -p.real(); }

Known random_known(test::Random& random, Kind kind, bool sampled) {
  Known known{MatrixXd(0, 0), Stability::asymptotic, 1e300};
  const auto add = [&](const MatrixXd& block, Complex p) {
    known.A = test::joined(known.A, block);
    known.margin = std::min(known.margin, inside_by(p, sampled));
  };
  const int others = static_cast<int>(test::uniform(random, 1, 4));
  for (int i = 0; i < others; ++i) {
    const Complex p = random_inside(random, sampled);
    add(test::block_of(p), p);
  }
  const Complex b = random_on_border(random, sampled);
  if (kind != Kind::inside) known.verdict = Stability::marginal;
  if (kind == Kind::simple) add(test::block_of(b), b);
  if (kind == Kind::two_apart) {
    add(test::block_of(b), b);
    const Complex other = sampled ? std::polar(1.0, std::arg(b) + 1e-3) : b + Complex(0, 1e-3);
    add(test::block_of(other), other);
  }
  if (kind == Kind::side_by_side) add(test::joined(test::block_of(b), test::block_of(b)), b);
  if (kind == Kind::defective) {
    add(defective(b), b);
    known.verdict = Stability::unstable;
  }
  if (kind == Kind::beyond) {
    const Complex out = sampled ? b * (1 + 1e-7) : b + 1e-7;
    add(test::block_of(out), out);
    known.verdict = Stability::unstable;
  }
  const MatrixXd Q = test::random_orthogonal(random, known.A.rows());
  known.A = Q * known.A * Q.transpose();
  return known;
}

TEST(Stability, IsCorrectForRandomSystemsWithKnownPoles) {
  test::Random random(5);
  int wrong = 0;
  for (int i = 0; i < 10'000; ++i) {
    const bool sampled = i % 2 == 0;
    const Kind kind = static_cast<Kind>((i / 2) % static_cast<int>(Kind::kCount));
    const Known known = random_known(random, kind, sampled);
    const Eigen::Index n = known.A.rows();
    const StateSpace system{known.A, MatrixXd::Zero(n, 1), MatrixXd::Zero(1, n), scalar(0),
                            sampled ? 1e-3 : 0.0};
    const StabilityReport report = judge_stability(system);
    if (report.verdict != known.verdict) ++wrong;
    EXPECT_EQ(report.verdict, known.verdict) << "case " << i << " kind " << static_cast<int>(kind);
    const double scale = sampled ? 1.0 : 1.0 + known.A.norm();
    EXPECT_NEAR(report.margin, known.margin, 1e-9 * scale) << "case " << i;
    if (wrong > 5) break;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Stability, MultipleRootsOnTheCircleAreUnstable) {
  // (z - 1)^2, (z^2 + 1)^2 and, for comparison, (z - 1)(z + 1).
  EXPECT_EQ(judge_roots(roots({1, -2, 1}), 1e-3).verdict, Stability::unstable);
  EXPECT_EQ(judge_roots(roots({1, 0, 2, 0, 1}), 1e-3).verdict, Stability::unstable);
  EXPECT_EQ(judge_roots(roots({1, 0, -1}), 1e-3).verdict, Stability::marginal);
  EXPECT_TRUE(judge_roots(roots({1, -2, 1}), 1e-3).multiple_on_border);
}

TEST(Stability, EmptySystemIsStable) {
  EXPECT_EQ(judge_roots(Eigen::VectorXcd(0), 0).verdict, Stability::asymptotic);
  EXPECT_EQ(spectral_radius(static_gain(scalar(2), 1e-3)), 0.0);
  EXPECT_THROW((void)spectral_radius(static_gain(scalar(2), 0)), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench::stability_test
