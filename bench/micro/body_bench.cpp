// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What bodies cost a servo step: a row of cubes on a floor, of which a hand holds down the first
// one or none. Each row holds the time of a step and how far the force is from that of the two
// springs in series, in newtons.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace {

using Eigen::Vector3d;
using namespace reckon::haptics;
using std::chrono::nanoseconds;

constexpr nanoseconds kPeriod{1'000'000};
constexpr double kEdge = 0.04;      // [m]
constexpr double kStiffness = 400;  // [N/m], of the cubes
constexpr double kGrip = 300;       // [N/m], of the hand
constexpr double kWanted = 0.005;   // [m], the hand into the cube

Scene row_of(std::size_t cubes, double mass) {
  Scene scene;
  SceneObject& floor = scene.objects.emplace_back();
  floor.name = "floor";
  floor.shape = PlaneShape{Vector3d::UnitZ()};
  floor.effects.of<SpringDamper>() = {kStiffness, 0.0};
  for (std::size_t i = 0; i < cubes; ++i) {
    SceneObject& cube = scene.objects.emplace_back();
    cube.name = "cube " + std::to_string(i);
    cube.shape = BoxShape{Vector3d::Constant(kEdge)};
    cube.pose.position = {kEdge * static_cast<double>(i), 0, 0.5 * kEdge};
    cube.effects.of<SpringDamper>() = {kStiffness, 0.0};
    cube.matter = {mass, 0.5, 0.0};
  }
  return scene;
}

// Arguments: cubes, grams of each, whether the first one is held down.
void servo_step_at_bodies(benchmark::State& state) {
  const bool holds = state.range(2) != 0;
  const Scene scene =
      row_of(static_cast<std::size_t>(state.range(0)), 1e-3 * static_cast<double>(state.range(1)));
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const auto world = make_bodies(*plan, scene);
  SimulatedDeviceConfig config;
  config.damping = 1.0;
  config.hand_stiffness = kGrip;
  config.start = {0, 0, 1.5 * kEdge};
  SimulatedDevice device(config, [holds](double t) {
    HandTarget target;
    target.position.z() = holds ? kEdge + 0.01 - (0.01 + kWanted) * std::min(1.0, t) : 1.5 * kEdge;
    return target;
  });
  ServoLoop servo(device, plan, ServoConfig{}, world);
  nanoseconds now{1'000'000'000};
  for (int i = 0; i < 3000; ++i) servo.step(now += kPeriod);
  const double right =
      holds && state.range(0) > 0 ? kStiffness * kGrip / (kStiffness + kGrip) * kWanted : 0.0;
  double error = 0.0;
  for (auto _ : state) {
    servo.step(now += kPeriod);
    state.PauseTiming();
    (void)servo.snapshots().update();
    error = std::max(error, std::abs(servo.snapshots().read().force.z() - right));
    state.ResumeTiming();
  }
  state.counters["error_n"] = error;
}
BENCHMARK(servo_step_at_bodies)
    ->ArgNames({"cubes", "grams", "held"})
    ->Args({0, 50, 0})
    ->Args({1, 50, 0})
    ->Args({1, 50, 1})
    ->Args({1, 1, 1})
    ->Args({6, 50, 0})
    ->Args({6, 50, 1})
    ->Args({27, 50, 0});

}  // namespace
