// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/two_port.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "reckon/bench/analysis/wave_line.hpp"
#include "reckon/bench/linear_systems/positive_real.hpp"
#include "reckon/tests/bench/linear_systems/random_systems.hpp"

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix2cd;

constexpr PortForm kForms[] = {PortForm::impedance, PortForm::admittance, PortForm::hybrid,
                               PortForm::inverse_hybrid, PortForm::chain};

Matrix2cd random_matrix(test::Random& random) {
  std::normal_distribution<double> normal;
  return Matrix2cd::NullaryExpr(2, 2, [&] { return Complex(normal(random), normal(random)); });
}

TEST(TwoPort, ConversionsBetweenAllFormsAreInvertible) {
  test::Random random(11);
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    // Dominant diagonal: all five forms exist and are well conditioned.
    const Matrix2cd Z = random_matrix(random) + 6.0 * Matrix2cd::Identity();
    const TwoPortMatrix two_port{PortForm::impedance, Z};
    for (const PortForm from : kForms) {
      const TwoPortMatrix start = converted(two_port, from);
      for (const PortForm to : kForms) {
        const Matrix2cd back = converted(converted(start, to), from).matrix;
        worst = std::max(worst, (back - start.matrix).norm() / start.matrix.norm());
      }
    }
  }
  EXPECT_LT(worst, 1e-12);
}

// The four quantities themselves, not only a conversion there and back.
TEST(TwoPort, AllFormsHoldForEqualEffortsAndFlows) {
  test::Random random(12);
  for (int i = 0; i < 100; ++i) {
    const TwoPortMatrix z{PortForm::impedance, random_matrix(random)};
    const Eigen::Vector2cd V(Complex(0.3, -1), Complex(2, 0.1)), F = z.matrix * V;
    const auto holds = [&](PortForm form, Complex a, Complex b, Complex in1, Complex in2) {
      const Eigen::Vector2cd out = converted(z, form).matrix * Eigen::Vector2cd(in1, in2);
      return (out - Eigen::Vector2cd(a, b)).norm() < 1e-9 * (1 + out.norm());
    };
    EXPECT_TRUE(holds(PortForm::admittance, V(0), V(1), F(0), F(1)));
    EXPECT_TRUE(holds(PortForm::hybrid, F(0), V(1), V(0), F(1)));
    EXPECT_TRUE(holds(PortForm::inverse_hybrid, V(0), F(1), F(0), V(1)));
    EXPECT_TRUE(holds(PortForm::chain, F(0), V(0), F(1), -V(1)));
  }
}

TEST(TwoPort, CascadeOfTwoLinesIsOneLongerLine) {
  const LineParameters line{3.0, 0.02}, both{3.0, 0.04};
  const double w = 7.0;
  const TwoPortMatrix joined = cascade(transmission_line(line, w), transmission_line(line, w));
  const TwoPortMatrix expected = converted(transmission_line(both, w), PortForm::chain);
  EXPECT_LT((joined.matrix - expected.matrix).norm(), 1e-12);
}

TEST(TwoPort, WireWithoutImpedanceMatrixIsRefused) {
  const TwoPortMatrix wire{PortForm::chain, Matrix2cd::Identity()};
  EXPECT_THROW((void)converted(wire, PortForm::impedance), std::invalid_argument);
  EXPECT_THROW((void)converted(wire, PortForm::admittance), std::invalid_argument);
  EXPECT_NO_THROW((void)converted(wire, PortForm::hybrid));
  EXPECT_NEAR(driving_impedance(wire, 5.0).real(), 5.0, 1e-15);
  TwoPortMatrix bad = wire;
  bad.matrix(0, 1) = NAN;
  EXPECT_THROW((void)converted(bad, PortForm::hybrid), std::invalid_argument);
}

TEST(TwoPort, CorrectedCriterionIsTheLeastEigenvaluesSign) {
  test::Random random(13);
  int passive = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Matrix2cd P = random_matrix(random) + 1.5 * Matrix2cd::Identity();
    const double least = Eigen::SelfAdjointEigenSolver<Matrix2cd>(P + P.adjoint()).eigenvalues()(0);
    EXPECT_EQ(passivity_margin(P) >= 0, least >= 0) << P;
    passive += least >= 0;
  }
  EXPECT_GT(passive, 1000);
  EXPECT_LT(passive, 9000);
}

TEST(TwoPort, PrintedCriterionMisjudgesALineAndAJunction) {
  const Matrix2cd line = transmission_line({1.0, 0.1}, 3.0).matrix;
  EXPECT_GE(passivity_margin(line), -1e-12);
  EXPECT_LT(printed_passivity_margin(line), -1);
  const Matrix2cd junction = delayed_junction(0.3).matrix;
  EXPECT_NEAR(passivity_margin(junction), -std::sin(0.3) * std::sin(0.3), 1e-15);
  EXPECT_GE(printed_passivity_margin(junction), -1e-15);
}

// Stable between any two passive one-ports: no passive load makes the real part at the other port
// negative. Loads on the imaginary axis are the worst.
TEST(TwoPort, LlewellynMatchesTheWorstPassiveLoad) {
  test::Random random(14);
  int stable = 0, differ = 0;
  for (int i = 0; i < 1000; ++i) {
    const Matrix2cd Z = random_matrix(random) + 1.2 * Matrix2cd::Identity();
    if (Z(0, 0).real() <= 0 || Z(1, 1).real() <= 0) continue;
    double worst = Z(0, 0).real();
    for (int k = 1; k < 4000; ++k) {
      const double x = std::tan(M_PI * (k / 4000.0 - 0.5));
      worst = std::min(worst, driving_impedance({PortForm::impedance, Z}, Complex(0, x)).real());
    }
    const double margin = llewellyn_margin(Z);
    if (std::abs(worst) < 1e-3) continue;
    EXPECT_EQ(margin >= 0, worst >= 0) << Z;
    stable += margin >= 0;
    differ += (margin >= 0) != (passivity_margin(Z) >= 0);
  }
  EXPECT_GT(stable, 100);
  EXPECT_GT(differ, 20) << "it is weaker than passivity";
}

TEST(TwoPort, SystemIsEvaluatedInItsForm) {
  // Two devices, 1/(m s + b) each, with a damper c between them: admittance (Z)^-1.
  const double m = 0.2, b = 0.5, c = 3.0, w = 12.0;
  Eigen::MatrixXd damping(2, 2);
  damping << b + c, -c, -c, b + c;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(2, 2);
  const TwoPort pair{PortForm::admittance, {-damping / m, I / m, I, 0 * I}};
  const Matrix2cd Z = converted(pair.at(w), PortForm::impedance).matrix;
  const Matrix2cd expected = damping.cast<Complex>() + Complex(0, w * m) * Matrix2cd::Identity();
  EXPECT_LT((Z - expected).norm(), 1e-13 * expected.norm());
  EXPECT_TRUE(judge_positive_real(pair.system).is_positive_real());
  EXPECT_GE(llewellyn_margin(pair.at(w).matrix), 0);
}

TEST(TwoPort, OnePortsHaveBothCausalities) {
  const auto scalar = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  const StateSpace device{scalar(-0.5 / 2), scalar(0.5), scalar(1), scalar(0)};  // 1/(2 s + 0.5)
  const OnePort port{Causality::admittance, device};
  EXPECT_LT(std::abs(port.impedance_at(3.0) - Complex(0.5, 6)), 1e-14);
  EXPECT_LT(std::abs(port.admittance_at(3.0) * Complex(0.5, 6) - 1.0), 1e-14);
}

}  // namespace
}  // namespace reckon::bench
