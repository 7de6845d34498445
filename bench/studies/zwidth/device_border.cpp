// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/zwidth/device_border.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reckon/bench/analysis/device_damping.hpp"
#include "reckon/bench/linear_systems/golden_section.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::bench {
namespace {

constexpr int kPerSample = 32;       // evaluated places, for each sample of delay and one more
constexpr double kPrecision = 1e-9;  // of the distance of places; a minimum is flat

/// Stiffness at which the wall needs all of the device's damping at theta [rad]; infinite if the
/// spring adds damping there.
double stiffness_at(const ZWidthDevice& device, double wall_damping, double theta) {
  const double per_stiffness = wall_damping_at(1, 0, device.period, theta, device.delay_samples);
  const double left =
      device.damping - wall_damping_at(0, wall_damping, device.period, theta, device.delay_samples);
  return per_stiffness > 0 ? left / per_stiffness : std::numeric_limits<double>::infinity();
}

}  // namespace

double passive_stiffness(const ZWidthDevice& device, double wall_damping) {
  if (!(std::abs(wall_damping) < device.damping)) return 0;
  const auto of = [&](double theta) { return stiffness_at(device, wall_damping, theta); };
  const int places = kPerSample * (device.delay_samples + 1);
  const double step = std::numbers::pi / places;
  const auto greatest = [&](int from, int to) {
    return greatest_between(from * step, to * step, kPrecision * step,
                            [&](double theta) { return -of(theta); })
        .value;
  };
  double least = std::min(of(0), of(std::numbers::pi));
  for (int i = 1; i < places; ++i) {
    const double middle = of(i * step);
    // A place lower than both its neighbours has the minimum of that section near it.
    if (middle <= of((i - 1) * step) && middle <= of((i + 1) * step))
      least = std::min(least, -greatest(i - 1, i + 1));
  }
  return least;
}

double undelayed_stiffness(const ZWidthDevice& device, double wall_damping) {
  return std::max(0.0, 2 * (device.damping - std::abs(wall_damping)) / device.period);
}

double servo_stiffness(const ZWidthDevice& device, double wall_damping) {
  haptics::SimulatedDeviceConfig simulated;
  simulated.damping = device.damping;
  simulated.delay_samples = device.delay_samples;
  simulated.max_stiffness = device.max_stiffness;
  haptics::SimulatedDevice handle(simulated);
  haptics::SceneObject wall;
  wall.name = "wall";
  wall.shape = haptics::PlaneShape{};
  wall.effects.of<haptics::SpringDamper>().damping = std::abs(wall_damping);
  haptics::ServoConfig config;
  config.period = peer::to_nanoseconds(device.period);
  const haptics::ServoLoop servo(handle, haptics::EffectPlan({"", {wall}}), config);
  return servo.static_stiffness_limit();
}

}  // namespace reckon::bench
