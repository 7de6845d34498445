// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two hands that hold a body, release it and hold it again make no energy, by their own ledgers,
// for any limitation of their force. RECKON_SOAK=1 tries 1,000 seeds.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/flaky_device.hpp"
#include "reckon/tests/haptics/support/held_cube.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::grab_adversary_test {
namespace {

using Eigen::Vector3d;
using faults::FlakyDevice;
using faults::weaken;
using grabbed::cube_of;
using grabbed::device_at;
using grabbed::holding;
using grabbed::kT;
using std::chrono::nanoseconds;

/// The path of a hand: slow waves about the cube.
struct Waves {
  explicit Waves(std::mt19937& random) {
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (auto& axis : waves)
      for (auto& wave : axis)
        wave = {0.025 * any(random), 1 + 9 * any(random), 2 * std::numbers::pi * any(random)};
    for (double& time : times) time = 0.2 + 2 * any(random);
  }
  HandTarget at(double t) const {
    HandTarget out;
    for (int k = 0; k < 3; ++k) {
      for (const auto& [size, rate, phase] : waves[static_cast<std::size_t>(k)]) {
        out.position[k] += size * std::sin(rate * t + phase);
        out.velocity[k] += size * rate * std::cos(rate * t + phase);
      }
    }
    if (t > 6) {  // away, each to its side
      out.position = out.position + Vector3d(0, 0, side * 0.3 * std::min(1.0, t - 6));
      return out;
    }
    double sum = 0;
    bool pressed = false;
    for (int i = 0; sum < t; ++i) {
      sum += times[static_cast<std::size_t>(i) % times.size()];
      pressed = !pressed;
    }
    out.buttons = pressed ? 1 : 0;
    return out;
  }
  std::array<std::array<std::array<double, 3>, 2>, 3> waves;
  std::array<double, 7> times{};
  double side = 1.0;
};

void draw_hand(std::size_t side, unsigned seed, std::mt19937& random,
               std::optional<FlakyDevice>& device) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Waves waves(random);
  waves.side = side == 0 ? 1.0 : -1.0;
  SimulatedDeviceConfig config = device_at(waves.at(0).position + Vector3d(0, 0, waves.side));
  config.damping = 0.05 * std::pow(60.0, any(random));
  weaken(config, random);
  device.emplace(config, [waves](double t) { return waves.at(t); });
  device->random.seed(seed);
  device->rate = random() % 3 == 0 ? 200 : 0;
}

// Two hands that hold, release and hold again: weak, late, unread, delayed, with encoder steps.
TEST(Grab, MakesNoEnergyUnderForceLimits) {
  double worst = -1e9, held = 0.0, both = 0.0, loan = 0.0;
  int free = 0;
  const int seeds = test::tries(16, 1000);
  for (unsigned seed = 1; seed <= static_cast<unsigned>(seeds); ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    const double mass = 0.003 * std::pow(300.0, any(random));
    Scene scene = cube_of(mass);
    if (random() % 3 == 0) scene.objects[0].grab = {200 * any(random), any(random), 0.5};
    const auto plan = std::make_shared<const EffectPlan>(scene);
    const auto world = std::make_shared<BodyWorld>(*plan, scene.gravity);
    std::array<std::optional<FlakyDevice>, 2> devices;
    std::array<std::optional<ServoLoop>, 2> servos;
    for (std::size_t s = 0; s < 2; ++s) {
      draw_hand(s, seed, random, devices[s]);
      servos[s].emplace(*devices[s], plan, holding(300 * any(random), 2 * any(random)), world);
    }
    const bool is_late = random() % 2 == 0;
    std::array<double, 2> damped{}, before{};
    std::array<bool, 2> touches{};
    nanoseconds now{1'000'000'000};
    for (int i = 0; i < 8'000; ++i) {
      double taken = 0.0, allowed = 0.0;
      int touched = 0, grabbed = 0;
      for (std::size_t s = 0; s < 2; ++s) {
        servos[s]->step(now);
        EXPECT_TRUE(servos[s]->snapshots().update());
        const ServoSnapshot& step = servos[s]->snapshots().read();
        // In free space the device's damping takes no energy of the interaction.
        const double loss = devices[s]->damping_loss();
        if (touches[s]) damped[s] += loss - before[s];
        before[s] = loss;
        touches[s] = step.in_mesh_contact || step.held.number > 0 || !step.force.isZero(0.0);
        taken += devices[s]->port_work() + damped[s];
        allowed += step.loan_most + step.late_cost + step.encoder_allowance;
        loan = std::max(loan, step.loan_most);
        touched += touches[s] ? 1 : 0;
        grabbed += step.held.number > 0 ? 1 : 0;
        ASSERT_GE(step.port_energy_min, -1e-9 - step.late_cost) << "seed " << seed;
      }
      held += grabbed > 0 ? kT : 0.0;
      both += grabbed > 1 ? kT : 0.0;
      free += touched == 0 ? 1 : 0;
      if (touched == 0) worst = std::max(worst, world->energy() - taken - allowed);
      ASSERT_LE(worst, 1e-9) << "seed " << seed << " at " << i << " ms, " << mass << " kg";
      ASSERT_TRUE(world->states()[0].position.allFinite()) << "seed " << seed;
      const bool late = is_late && random() % 20 == 0;
      now += late ? nanoseconds(1'000'000 + random() % 3'000'000) : nanoseconds(1'000'000);
    }
  }
  std::printf("held %.0f s, by both hands %.0f s, made at most %.3g J, lent %.3g J\n", held, both,
              worst, loan);
  EXPECT_GT(held, 0.5 * seeds);
  EXPECT_GT(both, 0.05 * seeds);
  EXPECT_GT(free, 250 * seeds);
}

}  // namespace
}  // namespace reckon::haptics::grab_adversary_test
