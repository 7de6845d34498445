// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two sides that do not wait for each other, as processes on two clocks: one is up to 5 samples
// ahead of the other. Compared with the same run in lock-step.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "reckon/bench/baselines/coupling_simulation.hpp"

namespace reckon::bench {
namespace {

constexpr std::uint32_t kSamples = 6000, kMostApart = 5;

std::array<std::vector<CouplingTrace>, 2> run_apart(const CouplingRun& run, unsigned seed) {
  const double period = run.device.period;
  SampleQueue to_first(run.network, period, run.seed, CouplingSide::first);
  SampleQueue to_second(run.network, period, run.seed, CouplingSide::second);
  QueueLink first_link(to_first, to_second), second_link(to_second, to_first);
  CouplingPeer first(run, CouplingSide::first, first_link);
  CouplingPeer second(run, CouplingSide::second, second_link);
  std::array<CouplingPeer*, 2> peers{&first, &second};
  std::array<std::vector<CouplingTrace>, 2> trace;
  std::mt19937 random(seed);
  while (first.samples() < kSamples || second.samples() < kSamples) {
    std::size_t who = random() % 2;
    if (peers[who]->samples() >= peers[1 - who]->samples() + kMostApart) who = 1 - who;
    if (peers[who]->samples() >= kSamples) who = 1 - who;
    peers[who]->step();
    trace[who].push_back({peers[who]->position(), peers[who]->force()});
  }
  return trace;
}

double rms_difference(const std::vector<CouplingTrace>& a, const std::vector<CouplingTrace>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i].force - b[i].force, 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

CouplingRun run_of(CouplingMode mode, double delay) {
  CouplingRun run;
  run.mode = mode;
  run.counterpart = Counterpart::hand;
  run.environment = Environment(EnvironmentKind::linear, 400);
  run.hand = operator_model(OperatorKind::soft);
  run.network = peer::delayed_by(delay);
  run.duration = kSamples * run.device.period;
  run.keep_trace = true;
  return run;
}

TEST(FreeRunning, EqualsLockStepForALongerDelay) {
  for (const CouplingMode mode : kCouplingModes) {
    const CouplingRun run = run_of(mode, 0.02);
    const CouplingOutcome together = simulate(run);
    auto apart = run_apart(run, 1);
    for (auto& trace : apart) trace.resize(together.trace[0].size());  // diverging runs end early
    EXPECT_TRUE(apart == together.trace) << name_of(mode);
  }
}

// On a perfect line a sample is up to 5 samples late: a varying delay. Modes that are stable at
// such delays stay near the run in lock-step.
TEST(FreeRunning, StaysNearLockStepOnAPerfectLine) {
  struct Stated {
    CouplingMode mode;
    double most;  // [N], rms
  };
  for (const auto& [mode, most] :
       {Stated{CouplingMode::gain_cut, 0.02}, Stated{CouplingMode::transmission_line, 0.05},
        Stated{CouplingMode::reckon, 0.5}}) {
    const CouplingRun run = run_of(mode, 0.0);
    const CouplingOutcome together = simulate(run);
    double worst = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const auto apart = run_apart(run, seed);
      for (std::size_t hand = 0; hand < 2; ++hand)
        worst = std::max(worst, rms_difference(apart[hand], together.trace[hand]));
    }
    std::printf(
        "%-18s force off by %.3f N rms from lock-step, itself off by %.3f N from the truth\n",
        std::string(name_of(mode)).c_str(), worst, together.error_rms);
    EXPECT_LT(worst, most) << "N, " << name_of(mode);
    EXPECT_GT(worst, 0.0) << name_of(mode);
  }
}

}  // namespace
}  // namespace reckon::bench
