// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a servo step costs: a simulated hand among n remote hands, all touching it, with and without
// a wall under it. Each row holds the time of a step and how far its force is from the closed form,
// in newtons, and the least energy of the port, in joules.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace {

using Eigen::Vector3d;
using namespace reckon::haptics;
using std::chrono::nanoseconds;

constexpr nanoseconds kPeriod{1'000'000};
constexpr double kRadius = 0.01;
constexpr double kStiffness = 100.0;  // eight of them stay below the passive limit
constexpr double kDepth = 0.001;

// n hands around ours, each pressed in by kDepth; their forces add up to a closed form.
ContactSet ring(std::size_t hands) {
  ContactSet set;
  set.count = hands;
  for (std::size_t i = 0; i < hands; ++i) {
    const double angle = 0.5 * std::numbers::pi * static_cast<double>(i) / 8.0;
    RemoteHand& hand = set.hands[i];
    hand.id = {1, 1, static_cast<std::uint16_t>(i + 1)};
    hand.state.position =
        (2.0 * kRadius - kDepth) * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    hand.model.kind = reckon::pdu::ForceModelKind::sphere;
    hand.model.radius = kRadius;
    hand.model.k1 = kStiffness;
    hand.valid_until = std::chrono::hours(24);
    hand.version = 1;
  }
  return set;
}

Vector3d expected(const ContactSet& set, const Vector3d& device) {
  Vector3d force = Vector3d::Zero();
  for (std::size_t i = 0; i < set.count; ++i) {
    const Vector3d away = device - set.hands[i].state.position;
    const double depth = 2.0 * kRadius - away.norm();
    if (depth > 0) force += kStiffness * depth * away.normalized();
  }
  return force;
}

void servo_step(benchmark::State& state) {
  const auto hands = static_cast<std::size_t>(state.range(0));
  Scene scene;
  if (state.range(1) != 0) {
    SceneObject wall;
    wall.name = "wall";
    wall.shape = PlaneShape{};
    wall.pose.position.z() = 0.002;
    wall.effects.of<SpringDamper>().stiffness = 800.0;
    scene.objects.push_back(wall);
  }
  SimulatedDeviceConfig config;
  config.hand_stiffness = 2000.0;  // holds the hand in the middle
  config.start.z() = 0.02;
  const auto press = [](double t) {
    HandTarget target;
    target.position.z() = std::max(0.0, 0.02 - 0.02 * t);
    return target;
  };
  SimulatedDevice device(config, press);
  ServoLoop servo(device, EffectPlan(scene), {.probe_radius = kRadius});
  const ContactSet set = ring(hands);
  nanoseconds now{0};
  servo.contacts().write(set);
  for (int i = 0; i < 4000; ++i, now += kPeriod) servo.step(now);

  for (auto _ : state) {
    // The model loop writes at half the servo's rate.
    if (now.count() / kPeriod.count() % 2 == 0) servo.contacts().write(set);
    servo.step(now);
    now += kPeriod;
  }
  servo.snapshots().update();
  const ServoSnapshot& last = servo.snapshots().read();
  state.counters["force_error_n"] =
      (last.force - last.mesh_force - expected(set, last.device)).norm();
  state.counters["energy_min_j"] = last.port_energy_min;
}

BENCHMARK(servo_step)
    ->ArgNames({"hands", "wall"})
    ->Args({0, 0})
    ->Args({0, 1})
    ->Args({1, 0})
    ->Args({1, 1})
    ->Args({8, 0});

// What of it is the simulated hand, to be taken off the rows above.
void simulated_device_alone(benchmark::State& state) {
  SimulatedDevice device({}, [](double) { return HandTarget{}; });
  nanoseconds now{0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(device.read(now).position);
    device.write(Vector3d::Zero(), now);
    now += kPeriod;
  }
}
BENCHMARK(simulated_device_alone);

}  // namespace
