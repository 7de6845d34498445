// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/wave_line.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "reckon/bench/analysis/power_ledger.hpp"
#include "reckon/tests/bench/linear_systems/random_systems.hpp"

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;

TEST(DelayedJunction, HasRealEigenvaluesPrintedAsImaginary) {
  for (const double theta : {0.0, 0.2, 1.5, 3.0, M_PI}) {
    const Eigen::Vector2d found = power_eigenvalues(delayed_junction(theta));
    EXPECT_NEAR(found(0), -2 * std::abs(std::sin(theta)), 1e-15);
    EXPECT_NEAR(found(1), 2 * std::abs(std::sin(theta)), 1e-15);
  }
}

// Driven along the eigenvector of -2 sin(wT): F1 = cos, V2 a quarter period from it.
TEST(DelayedJunction, GeneratesTheEnergyOfItsNegativeEigenvalue) {
  const double theta = 0.1, T = 1e-3;
  const int ticks = 62'832;  // nearly a thousand periods
  PowerLedger ledger(0.0);
  double late_F1 = 1.0, late_V2 = 0.0;
  for (int k = 0; k < ticks; ++k) {
    const double F1 = std::cos(theta * k), V2 = std::sin(theta * k);
    const std::array<PortValue, 2> ports = {{{F1, late_V2}, {-late_F1, V2}}};
    ledger.tick(ports, 0.0, 0.0, T);
    late_F1 = F1, late_V2 = V2;
  }
  EXPECT_NEAR(ledger.made() / (ticks * T), std::sin(theta), 1e-3) << "W";
}

TEST(TransmissionLine, IsLosslessOffItsPoles) {
  for (const double delay : {1e-3, 0.05, 1.0}) {
    for (double w = 0.37; w < 1000; w *= 1.7) {
      const LineParameters line{2.5, delay};
      const Complex lambda2 = std::polar(1.0, -2 * w * delay);
      if (std::abs(lambda2 - 1.0) < 1e-2) continue;
      EXPECT_LT(power_eigenvalues(transmission_line(line, w)).cwiseAbs().maxCoeff(), 1e-12);
      // 1e-12 of its entries, which are large near a pole.
      const TwoPortMatrix printed = printed_transmission_line(line, w);
      EXPECT_LT(power_eigenvalues(printed).cwiseAbs().maxCoeff(),
                1e-12 * (1 + printed.matrix.norm()));
    }
  }
}

TEST(TransmissionLine, PrintedDiagonalHasTheOtherSign) {
  const LineParameters line = line_of(0.5, 200);
  EXPECT_NEAR(line.impedance, 10, 1e-14);
  EXPECT_NEAR(line.delay, 0.05, 1e-16);
  const Eigen::Matrix2cd right = transmission_line(line, 9).matrix;
  const Eigen::Matrix2cd printed = printed_transmission_line(line, 9).matrix;
  EXPECT_LT(std::abs(printed(0, 0) + right(0, 0)), 1e-12);
  EXPECT_LT(std::abs(printed(0, 1) - right(0, 1)), 1e-12);
}

TEST(TransmissionLine, IsAPairOfDelayedWaves) {
  const LineParameters line{2.5, 0.3};
  const double w = 4.0;
  const Complex lambda = std::polar(1.0, -w * line.delay);
  const Eigen::Vector2cd V(Complex(1, 0.4), Complex(-0.2, 2));
  const Eigen::Vector2cd F = transmission_line(line, w).matrix * V;
  const double Z = line.impedance;
  EXPECT_LT(std::abs(F(1) - Z * V(1) - lambda * (F(0) + Z * V(0))), 1e-12);
  EXPECT_LT(std::abs(F(0) - Z * V(0) - lambda * (F(1) + Z * V(1))), 1e-12);
}

TEST(TransmissionLine, BalancesItsEnergyAtAnyConstantDelay) {
  test::Random random(15);
  std::normal_distribution<double> normal;
  for (const int delay : {1, 10, 200, 1000}) {
    WaveLine line(4.0, delay, 1e-3);
    PowerLedger ledger(0.0);
    std::vector<std::array<PortValue, 2>> past;
    for (int k = 0; k < 5000; ++k) {
      const WaveLine::Ends flows{normal(random), k < 2500 ? normal(random) : 0.0};
      const WaveLine::Ends efforts = line.step(flows);
      past.push_back({{{efforts.a, flows.a}, {efforts.b, flows.b}}});
      ledger.tick(past.back(), line.stored(), 0.0, 1e-3);
      if (k < delay) continue;
      // The same recurrence as in the frequency domain.
      const PortValue& a = past[static_cast<std::size_t>(k - delay)][0];
      EXPECT_NEAR(efforts.b - 4 * flows.b, a.effort + 4 * a.flow,
                  1e-9 * std::abs(efforts.b) + 1e-9);
    }
    EXPECT_LT(ledger.worst_imbalance(), 1e-9) << delay << " ms";
    EXPECT_LT(ledger.made(), 1e-9);
    EXPECT_GT(ledger.absorbed(), 0);
  }
}

TEST(TransmissionLine, MatchedEndAbsorbsTheWholeWave) {
  WaveLine line(4.0, 3, 1e-3);
  double flow_b = 0.0;
  double effort = 0.0;
  for (int k = 0; k < 20; ++k) {
    // F_b = -Z V_b, solved for the present sample: V_b = -v/sqrt(Z), from the line's output at 0.
    WaveLine probe = line;
    flow_b = -probe.step({1.0, 0.0}).b / (2 * 4.0);
    effort = line.step({1.0, flow_b}).a;
  }
  EXPECT_NEAR(effort, 4.0, 1e-12) << "nothing comes back: the port feels Z alone";
  EXPECT_NEAR(flow_b, -1.0, 1e-12);
}

TEST(TransmissionLine, BadNumbersAreRefused) {
  EXPECT_THROW(WaveLine(0, 1, 1e-3), std::invalid_argument);
  EXPECT_THROW(WaveLine(1, 0, 1e-3), std::invalid_argument);
  EXPECT_THROW(WaveLine(1, 1, 0), std::invalid_argument);
  EXPECT_THROW((void)line_of(0, 1), std::invalid_argument);
  EXPECT_THROW((void)power_eigenvalues({PortForm::chain, Eigen::Matrix2cd::Identity()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench
