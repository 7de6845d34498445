// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A failed reading does not remove the force from the hand: the hand's energy meanwhile is booked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::failed_reading_test {
namespace {

using bench::floor;
using namespace std::chrono_literals;

// Holds the force through a failed transfer, like hardware.
class FlakyDevice : public SimulatedDevice {
 public:
  using SimulatedDevice::SimulatedDevice;
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override {
    DeviceSample sample = SimulatedDevice::read(now);
    if (failures > 0) {
      --failures;
      sample.ok = false;
    }
    return sample;
  }
  int failures = 0;
};

// Pressed 10 mm into a floor and pulled out; one reading fails, or three in a row, on the way out
// (or on the way in).
struct Trial {
  double booked_too_much = 0;  // [J], of the meter against the device's own ledger
  double least = 0;            // [J], of the device's own ledger
  double force = 0, speed = 0;
};

Trial fail_once(int failures, double speed, bool outwards) {
  SimulatedDeviceConfig config;
  config.start.z() = 0.005;
  config.hand_stiffness = 3000;
  config.hand_damping = 20;
  FlakyDevice device(config, [=](double t) {
    const double down = outwards ? 0.05 * t : speed * std::max(0.0, t - 0.4);
    const double up = outwards ? speed * std::max(0.0, t - 0.4) : 0.0;
    HandTarget hand;
    hand.position.z() = 0.005 - std::min(0.015, down) + up;
    return hand;
  });
  ServoLoop servo(device, EffectPlan(floor(700)), {});
  Trial trial;
  bool failed = false;
  for (auto now = 0ms; now < 2s; now += 1ms) {
    const double v = device.velocity().z();
    const bool there = device.force().z() > 3 && (outwards ? v > 0.5 * speed : v < -0.5 * speed);
    if (!failed && now > 400ms && there) {
      failed = true;
      device.failures = failures;
      trial.force = device.force().z();
      trial.speed = v;
    }
    const bool good = device.failures == 0;
    servo.step(now);
    servo.snapshots().update();
    const double truth = device.port_work() + device.damping_loss();
    if (good) {
      trial.booked_too_much =
          std::max(trial.booked_too_much, servo.snapshots().read().port_energy - truth);
    }
    trial.least = std::min(trial.least, truth);
  }
  return trial;
}

TEST(FailedReading, IsBookedAtTheNextGoodReading) {
  for (const int failures : {1, 3}) {
    for (const double speed : {0.1, 0.3, 0.6}) {
      for (const bool outwards : {true, false}) {
        const Trial trial = fail_once(failures, speed, outwards);
        const double at_stake = trial.force * std::abs(trial.speed) * 1e-3;
        std::printf("%d failed, %.1f m/s %s: %.2f mJ at stake, %.3f mJ too much booked\n", failures,
                    speed, outwards ? "out" : "in", 1e3 * at_stake, 1e3 * trial.booked_too_much);
        ASSERT_GT(trial.force, 3.0);
        // A hand on 3000 N/m changes its speed by some per cent within the sample.
        EXPECT_LE(trial.booked_too_much, 0.1 * at_stake + 1e-9)
            << failures << " failed, " << speed << " m/s, outwards " << outwards;
        EXPECT_GE(trial.least, -1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace reckon::haptics::failed_reading_test
