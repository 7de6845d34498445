// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a reading of a Polhem: position and Jacobian from three angles, and the inverse, and the
// complete work of its driver from the octets of a report to the octets of a command. The first two
// rows have the greatest error of the round trip, in um.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <random>
#include <span>
#include <vector>

#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/polhem/polhem_kinematics.hpp"

namespace {

using Eigen::Vector3d;
using namespace reckon::haptics;

std::vector<Vector3d> places() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-polhem_facts().reach, polhem_facts().reach);
  std::vector<Vector3d> all;
  for (int i = 0; i < 4096; ++i)
    all.push_back(polhem_1().middle + Vector3d(within(random), within(random), within(random)));
  return all;
}

double error_um(const std::vector<Vector3d>& all) {
  double most = 0;
  for (const Vector3d& p : all) {
    const auto angles = polhem_angles(polhem_1(), p);
    const auto pose = angles ? polhem_pose(polhem_1(), *angles) : std::nullopt;
    most = std::max(most, pose ? 1e6 * (pose->position - p).norm() : 1e6);
  }
  return most;
}

void polhem_forward(benchmark::State& state) {
  const std::vector<Vector3d> all = places();
  std::vector<Vector3d> angles;
  for (const Vector3d& p : all)
    angles.push_back(polhem_angles(polhem_1(), p).value_or(Vector3d::Zero()));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(polhem_pose(polhem_1(), angles[i++ % angles.size()]));
  state.counters["error_um"] = error_um(all);
}
BENCHMARK(polhem_forward);

void polhem_inverse(benchmark::State& state) {
  const std::vector<Vector3d> all = places();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(polhem_angles(polhem_1(), all[i++ % all.size()]));
  state.counters["error_um"] = error_um(all);
}
BENCHMARK(polhem_inverse);

// From the start pose, in which its button was pressed.
void polhem_exchange(benchmark::State& state) {
  PolhemDriver driver({0.17, 0.055});
  std::array<std::uint8_t, 14> octets{0, 0, 0, 0, 0x78, 0xEC};
  const UsbForce force{Vector3d(1, 2, 3)};
  UsbReading reading;
  UsbStage stage = UsbStage::silent;
  const auto exchange = [&](std::uint8_t info) {
    octets[12] = info;
    octets[0] = static_cast<std::uint8_t>((octets[0] + 1) % 50);
    std::span<const std::uint8_t> transfer(octets);
    if (driver.read(transfer)) stage = driver.judge(stage == UsbStage::running, reading);
    benchmark::DoNotOptimize(
        driver.command(stage, stage == UsbStage::running ? &force : nullptr).data());
  };
  for (const int info : {1, 1, 0, 0}) exchange(static_cast<std::uint8_t>(info));
  if (stage != UsbStage::running) return state.SkipWithError("it is not homed");
  for (auto _ : state) exchange(0);
}
BENCHMARK(polhem_exchange);

}  // namespace
