// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a reading of a Falcon: position and Jacobian from three angles, and the inverse. Each row
// has the time of one and the greatest error of the round trip, in um.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

#include "reckon/haptics/falcon/falcon_kinematics.hpp"

namespace {

using Eigen::Vector3d;
using namespace reckon::haptics;
using G = FalconGeometry;

std::vector<Vector3d> places() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-G::kReach, G::kReach);
  std::vector<Vector3d> all;
  for (int i = 0; i < 4096; ++i)
    all.emplace_back(within(random), within(random), G::kMiddle + within(random));
  return all;
}

double error_um(const std::vector<Vector3d>& all) {
  double most = 0;
  for (const Vector3d& p : all) {
    const auto angles = falcon_angles(p);
    const auto pose = angles ? falcon_pose(*angles) : std::nullopt;
    most = std::max(most, pose ? 1e6 * (pose->position - p).norm() : 1e6);
  }
  return most;
}

void falcon_forward(benchmark::State& state) {
  const std::vector<Vector3d> all = places();
  std::vector<Vector3d> angles;
  for (const Vector3d& p : all) angles.push_back(falcon_angles(p).value_or(Vector3d::Zero()));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(falcon_pose(angles[i++ % angles.size()]));
  state.counters["error_um"] = error_um(all);
}
BENCHMARK(falcon_forward);

void falcon_inverse(benchmark::State& state) {
  const std::vector<Vector3d> all = places();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(falcon_angles(all[i++ % all.size()]));
  state.counters["error_um"] = error_um(all);
}
BENCHMARK(falcon_inverse);

}  // namespace
