// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/power_ledger.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "reckon/bench/analysis/device_damping.hpp"

namespace reckon::bench {
namespace {

// A hand's force on a mass, with a damper and a spring in series attached to the mass. The midpoint
// rule conserves the energy of linear elements exactly.
struct Network {
  double m = 0.3, b = 1.5, k = 400, T = 1e-3;
  double v = 0.0, x = 0.0;          // of the mass, of the spring
  std::array<PortValue, 3> body;    // hand, mass, branch: one flow
  std::array<PortValue, 3> branch;  // branch seen from the mass, spring, damper: one effort
  double dissipated = 0.0;

  double stored() const { return 0.5 * m * v * v + 0.5 * k * x * x; }

  void step(double push) {
    // Means over the tick: v_m = v + h a, x_m = x + h (v_m - k x_m/b), m a = push - k x_m, h = T/2.
    const double h = 0.5 * T;
    const double x_m = (x + h * (v + h / m * push)) / (1 + h * k / b + h * h * k / m);
    const double force = k * x_m;
    const double a = (push - force) / m, v_m = v + h * a;
    const double spring_flow = v_m - force / b;
    v += T * a;
    x += T * spring_flow;
    dissipated = force * force / b * T;
    body = {{{push, -v_m}, {m * a, v_m}, {force, v_m}}};
    branch = {{{-force, v_m}, {force, spring_flow}, {force, force / b}}};
  }
};

TEST(PowerLedger, BalancesToANanojoulePerTick) {
  Network network;
  PowerLedger ledger(network.stored());
  for (int i = 0; i < 100'000; ++i) {
    const double push = 5 * std::sin(0.01 * i) + (i % 1000 < 500 ? 3.0 : -3.0);
    network.step(push);
    const PortValue hand{push, -network.body[0].flow};
    ledger.tick(std::span(&hand, 1), network.stored(), network.dissipated, network.T);
  }
  EXPECT_LT(ledger.worst_imbalance(), 1e-9);
  EXPECT_EQ(ledger.made(), 0.0);
  EXPECT_GT(ledger.absorbed(), 1.0);
}

TEST(PowerLedger, JunctionsTakeNoPower) {
  Network network;
  for (int i = 0; i < 1000; ++i) {
    network.step(4.0);
    // The hand pushes, mass and branch push back: one flow, with signs that add to 0.
    std::array<PortValue, 3> flow = network.body;
    flow[0] = {-network.body[0].effort, -network.body[0].flow};
    EXPECT_LT(junction_residual(Junction::common_flow, flow), 1e-9);
    EXPECT_NEAR(power(flow), 0.0, 1e-9);
    // Spring and damper in series: one effort, and flows that add up to the branch's.
    std::array<PortValue, 3> effort = network.branch;
    effort[0] = {-network.branch[0].effort, -network.branch[0].flow};
    EXPECT_LT(junction_residual(Junction::common_effort, effort), 1e-9);
    EXPECT_NEAR(power(effort), 0.0, 1e-9);
  }
}

TEST(PowerLedger, GivesMissingAndGeneratedEnergy) {
  PowerLedger ledger(2.0);
  const PortValue out{3.0, -1.0};  // 3 W out of the network
  EXPECT_NEAR(ledger.tick(std::span(&out, 1), 1.0, 0.0, 0.5), -0.5, 1e-15);
  EXPECT_EQ(ledger.made(), 0.0) << "it had 2 J";
  ledger.tick(std::span(&out, 1), 0.0, 0.0, 0.5);
  EXPECT_NEAR(ledger.made(), 1.0, 1e-15);
  EXPECT_NEAR(ledger.absorbed(), -3.0, 1e-15);
}

// Pressed in and released at one speed, with the force held over each sample: it returns K v T X
// more than it received. A damper of K T/2 dissipates exactly that on this path, (3.8).
TEST(PowerLedger, SampledSpringGeneratesTheEnergyOfThreeEight) {
  const double K = 2000, v = 0.1, X = 5e-3;
  for (const double T : {1e-3, 1e-2}) {
    PowerLedger spring(0.0), damped(0.0);
    const int samples = static_cast<int>(std::lround(X / (v * T)));
    for (int k = 0; k < 2 * samples; ++k) {
      const double flow = k < samples ? v : -v;
      const double x = k < samples ? k * v * T : X - (k - samples) * v * T;
      const double damper = wall_damping(K, 0, T) * flow;
      const std::array<PortValue, 2> ports = {{{K * x, flow}, {damper, flow}}};
      spring.tick(std::span(ports.data(), 1), 0.0, 0.0, T);
      damped.tick(ports, 0.0, damper * flow * T, T);
    }
    EXPECT_NEAR(spring.made(), K * v * T * X, 1e-15);
    EXPECT_NEAR(spring.made() / (0.5 * K * X * X), 40 * T, 1e-12)
        << "4 % and 40 % of what it holds";
    EXPECT_NEAR(damped.made(), 0.0, 1e-15);
    EXPECT_NEAR(damped.absorbed(), 0.0, 1e-15);
  }
}

TEST(PowerLedger, ResidualDetectsABrokenJunction) {
  const std::array<PortValue, 2> ports = {{{1.0, 2.0}, {1.5, -2.0}}};
  EXPECT_NEAR(junction_residual(Junction::common_effort, ports), 0.5, 1e-15);
  EXPECT_NEAR(junction_residual(Junction::common_flow, ports), 4.0, 1e-15);
}

}  // namespace
}  // namespace reckon::bench
