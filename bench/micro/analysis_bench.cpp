// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of judging a received force model, for each order: positive realness and the device damping
// that it needs. The models have a known result, which is checked first and appears in the row as
// error.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "reckon/bench/analysis/device_damping.hpp"
#include "reckon/bench/analysis/virtual_environment.hpp"
#include "reckon/bench/linear_systems/positive_real.hpp"

namespace {

using Eigen::MatrixXd;
using namespace reckon::bench;

// A ladder of n damped oscillators 1 - h_i b_i(s), with b_i a band-pass of peak 1, over six decades
// and each with an n-th of the total, so that the least real part is known up to the overlap.
StateSpace band_passes(Eigen::Index modes) {
  const Eigen::Index n = 2 * modes;
  StateSpace s{MatrixXd::Zero(n, n), MatrixXd::Zero(n, 1), MatrixXd::Zero(1, n),
               MatrixXd::Constant(1, 1, 1.0), 0.0};
  for (Eigen::Index i = 0; i < modes; ++i) {
    const double w0 =
        std::pow(10.0, 6.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(modes));
    const double g = 2 * 1e-4 * w0;
    s.A(2 * i, 2 * i + 1) = w0;
    s.A(2 * i + 1, 2 * i) = -w0;
    s.A(2 * i + 1, 2 * i + 1) = -g;
    s.B(2 * i + 1, 0) = g;
    s.C(0, 2 * i + 1) = i == modes / 2 ? -1.001 : -0.5;
  }
  return s;
}

void positive_real(benchmark::State& state) {
  const StateSpace model = band_passes(state.range(0) / 2);
  const double least = judge_positive_real(model).least;
  if (std::abs(least + 1e-3) > 1e-4) {
    state.SkipWithError("the dip of 1e-3 was not found");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(judge_positive_real(model));
  state.counters["error"] = std::abs(least + 1e-3);
}
BENCHMARK(positive_real)->Arg(2)->Arg(4)->Arg(8)->Arg(16)->Arg(32)->Arg(64);

void device_damping(benchmark::State& state) {
  const auto delay = static_cast<int>(state.range(0));
  const TransferFunction wall =
      virtual_wall(800, 0, 1e-3, SpringReading::with_period);
  const double known = spring_damping(800, 1e-3, delay);
  const double error = std::abs(required_device_damping(wall, delay).required / known - 1);
  if (error > 1e-9) {
    state.SkipWithError("not the closed form");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(required_device_damping(wall, delay));
  state.counters["error"] = error;
}
BENCHMARK(device_damping)->Arg(0)->Arg(1)->Arg(5)->Arg(20);

}  // namespace
