// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/coupling_simulation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>

#include "reckon/bench/analysis/wave_line.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::bench::coupling_simulation_test {
namespace {

constexpr double kPassive = -1e-9;  // [J]
constexpr std::array kOperators{OperatorKind::push, OperatorKind::soft, OperatorKind::tracking};

CouplingRun run_of(CouplingMode mode, Counterpart counterpart, double stiffness) {
  CouplingRun run;
  run.mode = mode;
  run.counterpart = counterpart;
  run.environment = Environment(EnvironmentKind::linear, stiffness);
  return run;
}

TEST(CouplingMode, HasANameForLookUp) {
  for (const CouplingMode mode : kCouplingModes) EXPECT_EQ(coupling_mode(name_of(mode)), mode);
  EXPECT_FALSE(coupling_mode("wave"));
  EXPECT_EQ(name_of(CouplingMode::transmission_line), "transmission_line");
}

TEST(Environment, ForceIsTheSlopeOfTheEnergy) {
  for (const auto kind : {EnvironmentKind::linear, EnvironmentKind::hardening,
                          EnvironmentKind::moving, EnvironmentKind::switching}) {
    const Environment environment(kind, 800);
    for (double t = 0.05; t < 1.2; t += 0.1) {
      const ContactLaw law = environment.at(t);
      for (const double x : {-0.01, -0.001, 0.0005, 0.004, 0.02}) {
        const double h = 1e-7;
        EXPECT_NEAR((law.energy(x + h) - law.energy(x - h)) / (2 * h), law.force(x), 1e-5);
        const Tangent tangent = law.tangent(x);
        EXPECT_NEAR(tangent.stiffness * std::max(0.0, x - tangent.surface), law.force(x), 1e-12);
      }
    }
  }
}

// The force is 2 N where the linear one is 1 N: numbers of the published grid.
TEST(Environment, HardeningSpringDoublesTheForceAtOneNewton) {
  const ContactLaw law = Environment(EnvironmentKind::hardening, 800).at(0);
  EXPECT_NEAR(law.force(1.0 / 200), 2.0, 1e-12);
}

TEST(CouplingSimulation, IsDeterministicForASeed) {
  for (const CouplingMode mode : kCouplingModes) {
    CouplingRun run = run_of(mode, Counterpart::hand, 400);
    run.network = peer::delayed_by(0.02, 0.3, 0.2);
    run.network.reorder = 0.1;
    run.duration = 2;
    run.keep_trace = true;
    const CouplingOutcome one = simulate(run);
    CouplingOutcome again;
    std::thread([&] { again = simulate(run); }).join();
    EXPECT_EQ(one.trace, again.trace) << name_of(mode);
    EXPECT_EQ(one.least_sum, again.least_sum);
    EXPECT_EQ(one.error_rms, again.error_rms);
    run.seed = 2;
    EXPECT_NE(one.trace, simulate(run).trace) << name_of(mode);
  }
}

TEST(CouplingSimulation, LocalModelsRenderALinearWallExactly) {
  for (const CouplingMode mode :
       {CouplingMode::velocity_exchange, CouplingMode::printed_dead_reckoning,
        CouplingMode::passivity_controller, CouplingMode::reckon}) {
    CouplingRun run = run_of(mode, Counterpart::server, 500);
    run.network = peer::delayed_by(0.1, 0.3);
    const CouplingOutcome outcome = simulate(run);
    EXPECT_FALSE(outcome.made_energy()) << name_of(mode);
    EXPECT_NEAR(outcome.stiffness_kept, 1.0, 1e-3) << name_of(mode);
    EXPECT_LT(outcome.error_rms, 0.05) << name_of(mode) << ": one sample late at most";
    EXPECT_LT(outcome.rms_speed, 1e-3) << name_of(mode);
  }
}

// 2 N against a spring: the correct answer is known without simulation.
TEST(CouplingSimulation, TruthIsTheOperatorsForceAtRest) {
  CouplingRun run = run_of(CouplingMode::reckon, Counterpart::hand, 400);
  run.duration = 6;
  run.update_hz = 1000;
  const CouplingOutcome outcome = simulate(run);
  EXPECT_NEAR(outcome.truth_p95, 2.0, 0.05);
  EXPECT_LT(outcome.error_rms, 0.08)
      << "nothing between the two hands but a sample, and what a hand receives at once";
}

TEST(CouplingSimulation, MakesEnergyWithTheGateOff) {
  CouplingRun run = run_of(CouplingMode::reckon, Counterpart::server, 500);
  run.environment = Environment(EnvironmentKind::switching, 1500);
  run.hand = operator_model(OperatorKind::soft);
  run.network = peer::delayed_by(0.05, 0.3, 0.3);
  EXPECT_FALSE(simulate(run).made_energy());
  run.gate = false;
  EXPECT_TRUE(simulate(run).made_energy());
}

TEST(CouplingSimulation, RefusesParametersOutOfRangeByName) {
  const auto complaint = [](const CouplingRun& run) -> std::string {
    try {
      (void)simulate(run);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  CouplingRun run;
  run.network.loss = 1.5;
  EXPECT_NE(complaint(run).find("loss = 1.5 is not a share"), std::string::npos);
  run = {};
  run.update_hz = 2000;
  EXPECT_NE(complaint(run).find("update rate"), std::string::npos);
  run = {};
  run.counterpart = Counterpart::hand;
  run.environment = Environment(EnvironmentKind::moving, 500);
  EXPECT_NE(complaint(run).find("two hands press on a linear spring"), std::string::npos);
}

TEST(CouplingEnd, AllocatesNothingInAStep) {
  for (const CouplingMode mode : kCouplingModes) {
    for (const auto side : {CouplingSide::first, CouplingSide::second}) {
      CouplingEndConfig config;
      config.mode = mode;
      config.side = side;
      config.counterpart = Counterpart::hand;
      const auto end = make_coupling_end(config);
      CouplingSample sample;
      const test::AllocationGuard guard;
      for (std::uint32_t k = 0; k < 500; ++k) {
        (void)end->step({k, 0.001 * std::sin(0.05 * k), 0.05}, {&sample, k % 20 == 5 ? 1u : 0u});
        if (k % 20 == 0) sample = end->sample();
      }
      EXPECT_EQ(guard.count(), 0u) << name_of(mode);
    }
  }
}

// Samples passed by the test: two late to the world and one late back, for the hand sends its
// reflection one sample later. The waves are equal to the analysis' line.
TEST(TransmissionLine, IsTheWaveLineOfTheAnalysis) {
  CouplingEndConfig config;
  config.mode = CouplingMode::transmission_line;
  config.impedance = 2.0;
  const auto hand = make_coupling_end(config);
  config.side = CouplingSide::second;
  const auto world = make_coupling_end(config);
  WaveLine line(config.impedance, 2, config.period);
  const double T = config.period, Z = config.impedance, root = std::sqrt(Z);
  std::array<CouplingSample, 2> out{};  // to the world
  CouplingSample back;                  // to the hand
  double x = kCouplingStart, point = kCouplingStart, strongest = 0;
  for (std::uint32_t k = 0; k < 3000; ++k) {
    const double speed = k > 0 ? 0.05 * std::sin(0.004 * k) : 0.0;
    x += speed * T;
    (void)hand->step({k, x, speed}, {&back, 1});
    const CouplingSample arrived = out[0];
    const double force = world->step({k, 0, 0}, {&arrived, 1});
    out = {out[1], hand->sample()};
    back = world->sample();
    const double point_speed = (arrived.effort - back.effort) / root;
    const WaveLine::Ends efforts = line.step({speed, -point_speed});
    ASSERT_NEAR((efforts.b + Z * point_speed) / (2 * root), arrived.effort, 1e-12) << k;
    point += point_speed * T;
    ASSERT_NEAR(force, config.environment.stiffness() * std::max(0.0, point), 1e-9) << k;
    strongest = std::max(strongest, force);
  }
  EXPECT_GT(strongest, 0.5) << "N: the surface was met";
}

TEST(TransmissionLine, MakesNoEnergyAtConstantDelay) {
  int runs = 0;
  for (const auto counterpart : {Counterpart::server, Counterpart::hand})
    for (const OperatorKind hand : kOperators)
      for (const double delay : {0.0, 0.02, 0.1, 0.5})
        for (const double hz : {1000.0, 50.0})
          for (const double damping : {1.0, 0.05}) {
            CouplingRun run = run_of(CouplingMode::transmission_line, counterpart, 900 * damping);
            run.hand = operator_model(hand);
            run.device.damping = damping;
            run.network = peer::delayed_by(delay);
            run.uplink_hz = run.update_hz = hz;
            run.duration = 5;
            const CouplingOutcome outcome = simulate(run);
            EXPECT_GE(outcome.least_sum, kPassive)
                << 1e3 * delay << " ms, " << hz << " Hz, operator " << name_of(hand);
            ++runs;
          }
  EXPECT_EQ(runs, 96);
}

// With a device of little damping, which would otherwise hide it.
TEST(TransmissionLine, MakesEnergyUnderVaryingDelay) {
  double least = 0;
  for (const OperatorKind hand : kOperators)
    for (const double delay : {0.02, 0.05, 0.2}) {
      CouplingRun run = run_of(CouplingMode::transmission_line, Counterpart::server, 25);
      run.hand = operator_model(hand);
      run.device.damping = 0.05;
      run.impedance = 2.0;
      run.uplink_hz = run.update_hz = 1000;
      run.network = peer::delayed_by(delay);
      EXPECT_GE(simulate(run).least_sum, kPassive);
      run.network = peer::delayed_by(delay, 0.3);
      least = std::min(least, simulate(run).least_sum);
    }
  EXPECT_LT(least, -1e-4) << "J";
  std::printf("jitter of 30 %%: %.1e J\n", least);
}

// The world of a moving or switching surface works on the hand through a lossless line: with that
// work included no energy is generated.
TEST(TransmissionLine, TransmitsTheWorkOfAMovingWorld) {
  for (const auto kind : {EnvironmentKind::moving, EnvironmentKind::switching})
    for (const OperatorKind hand : kOperators) {
      CouplingRun run = run_of(CouplingMode::transmission_line, Counterpart::server, 900);
      run.environment = Environment(kind, 900);
      run.hand = operator_model(hand);
      run.network = peer::delayed_by(0.02);
      EXPECT_GE(simulate(run).least_sum, kPassive) << name_of(kind) << ", " << name_of(hand);
    }
}

}  // namespace
}  // namespace reckon::bench::coupling_simulation_test
