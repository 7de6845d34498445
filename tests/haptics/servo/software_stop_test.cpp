// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The software stop removes the force in its own step, for as long as it is pressed, and costs no
// energy. At the start and after a stop forces return at most at the rate of the limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/haptics/servo/safety.hpp"
#include "reckon/tests/haptics/support/hands_in_a_row.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::software_stop_test {
namespace {

using bench::Bench;
using bench::floor;
using bench::presses;
using Eigen::Vector3d;
using namespace std::chrono_literals;

constexpr double kRoundOff = 1e-9;                   // [J], [N]
constexpr double kRise = 10.0 / Safety::kRampSteps;  // [N] in a sample, of a device of 10 N

ServoConfig stopped_by(ForceStop& stop) {
  ServoConfig config;
  config.stop = &stop;
  return config;
}

TEST(SoftwareStop, RemovesTheForceInItsStep) {
  ForceStop stop;
  Bench bench(floor(800), bench::at(0.03), presses(0.015), stopped_by(stop));
  ASSERT_GT(bench.run(2s).force.norm(), 1.0);
  stop.press(StopCause::program);
  bench.run(1ms);
  EXPECT_TRUE(bench.device.force().isZero(0.0)) << "in the very step";
  EXPECT_TRUE(bench.servo.snapshots().read().stopped);
  EXPECT_FALSE(bench.servo.snapshots().read().enabled);
  for (int i = 0; i < 3000; ++i) {
    bench.run(1ms);
    ASSERT_TRUE(bench.device.force().isZero(0.0)) << i;
  }
  const ServoSnapshot& s = bench.servo.snapshots().read();
  EXPECT_NEAR(s.tally.stopped, 3.001, 1e-9);
  EXPECT_EQ(s.trips, 0U) << "it is no fault";
}

TEST(SoftwareStop, FailedReadingDoesNotReleaseIt) {
  ForceStop stop;
  Bench bench(floor(800), bench::at(0.03), presses(0.015), stopped_by(stop));
  bench.run(2s);
  stop.press(StopCause::program);
  for (int i = 0; i < 200; ++i) {
    bench.device.plug(i % 7 != 0);
    bench.run(1ms);
    ASSERT_TRUE(bench.device.force().isZero(0.0)) << i;
  }
}

TEST(SoftwareStop, DeviceButtonPressesAndReleasesIt) {
  ServoConfig config;
  config.stop_button = 1;
  Bench bench(floor(800), bench::at(0.03), presses(0.015), config);
  const double before = bench.run(2s).force.norm();
  ASSERT_GT(before, 1.0);
  bench.device.press(0b10);
  EXPECT_TRUE(bench.run(1ms).force.isZero(0.0));
  bench.device.press(0);
  EXPECT_TRUE(bench.run(1s).force.isZero(0.0));
  bench.device.press(0b10);
  EXPECT_NEAR(bench.run(3s).force.norm(), before, 0.1 * before);
}

// Largest growth of the force in one sample [N].
double fastest_return(Bench& bench, std::chrono::milliseconds time) {
  double fastest = 0.0, last = bench.device.force().norm();
  for (auto passed = 0ms; passed < time; passed += 1ms) {
    const double force = bench.run(1ms).force.norm();
    fastest = std::max(fastest, force - last);
    last = force;
  }
  return fastest;
}

TEST(SoftwareStop, WallFadesInAsAfterATrip) {
  ForceStop stop;
  Bench bench(floor(1400), bench::at(0.03), presses(0.015), stopped_by(stop));
  const double before = bench.run(3s).force.norm();
  stop.press(StopCause::program);
  bench.run(500ms);
  stop.release(StopCause::program);
  EXPECT_LE(fastest_return(bench, 3s), kRise + kRoundOff);
  EXPECT_GE(bench.device.force().norm(), 0.9 * before);
}

// 20 mm up and down at 5 Hz: it hits the floor at 0.6 m/s, where 1400 N/m give 0.9 N in a sample.
double strikes(double t) { return 0.015 + 0.02 * std::cos(31.4 * t); }

// Largest excess of the force over 0.1 N per sample in the next 0.1 s [N].
double above_the_rise(Bench& bench) {
  double most = -1.0;
  for (int step = 1; step <= Safety::kRampSteps; ++step)
    most = std::max(most, bench.run(1ms).force.norm() - kRise * step);
  return most;
}

TEST(SoftwareStop, EarlyBlowStaysBelowTheRisingLimit) {
  for (const int wait : {0, 20, 40, 60}) {
    ForceStop stop;
    SimulatedDeviceConfig device = bench::at(0.002);
    device.hand_stiffness = 3000;
    device.hand_damping = 20;
    const double ahead = 0.075 - 1e-3 * wait;  // 7 ms before the blow, if `wait` is 0
    Bench bench(
        floor(1400), device,
        [=](double t) {
          HandTarget hand;
          hand.position.z() = strikes(t + ahead);
          return hand;
        },
        stopped_by(stop));
    EXPECT_LE(above_the_rise(bench), kRoundOff) << "from the start, " << wait;
    EXPECT_GT(fastest_return(bench, 400ms), 4 * kRise) << "later it strikes as hard as it does";
    stop.press(StopCause::program);
    bench.run(std::chrono::milliseconds(200 + wait));
    stop.release(StopCause::program);
    bench.run(1ms);  // the servo sees the release; last step without a force
    EXPECT_LE(above_the_rise(bench), kRoundOff) << "after the stop, " << wait;
  }
}

// The device's own ledger, for stops of any length at any instant.
TEST(SoftwareStop, StopsAtRandomInstantsMakeNoEnergy) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    ForceStop stop;
    SimulatedDeviceConfig device = bench::at(0.03);
    device.hand_stiffness = 100 + 900 * uniform(random);
    device.mass = 0.05 + 0.4 * uniform(random);
    device.delay_samples = static_cast<int>(seed % 3);
    const double depth = 0.005 + 0.015 * uniform(random), waves = 1 + 9 * uniform(random);
    Scene scene = floor(300 + 1500 * uniform(random), 0.2 * uniform(random));
    Bench bench(
        scene, device,
        [=](double t) {
          HandTarget hand;
          hand.position.z() = std::max(-depth, 0.03 - 0.1 * t) + 0.004 * std::sin(waves * t);
          hand.position.x() = 0.01 * std::sin(0.7 * waves * t);
          return hand;
        },
        stopped_by(stop));
    for (int i = 0; i < 60; ++i) {
      bench.run(std::chrono::milliseconds(1 + random() % 300));
      stop.toggle(StopCause::program);
      bench.run(std::chrono::milliseconds(random() % 150));
      stop.toggle(StopCause::program);
    }
    const ServoSnapshot& s = bench.servo.snapshots().read();
    EXPECT_GE(bench.least, -kRoundOff) << "seed " << seed;
    EXPECT_GE(s.port_energy_min, -kRoundOff) << "seed " << seed;
    EXPECT_LE(s.loan_most, kGreatestLoan + kRoundOff);
    EXPECT_GT(bench.peak, 0.3) << "seed " << seed << ": it was felt at all";
  }
}

TEST(SoftwareStop, StoppingTwoPushingHandsMakesNoEnergy) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    ForceStop stop;
    RowHands hands;
    hands.stop = &stop;
    hands.target = [&](std::size_t i, double t) {
      return i == 0 ? 0.02 * smooth(t) + 0.003 * std::sin(5 * t) : 0.0;
    };
    RowLine line;
    line.delay = seed % 2 == 0 ? 0.02 : 0.0003;
    HandsInARow row(hands, line, seed);
    std::mt19937 random(seed);
    const auto steps = [&](std::uint64_t count) {
      for (std::uint64_t i = 0; i < count; ++i) row.step();
    };
    steps(2000);
    for (int i = 0; i < 30; ++i) {
      steps(1 + random() % 400);
      stop.press(StopCause::program);
      steps(1 + random() % 200);
      EXPECT_TRUE(row.device(0).force().isZero(0.0) && row.device(1).force().isZero(0.0));
      stop.release(StopCause::program);
    }
    double most = 0.0;
    for (int i = 0; i < 5000; ++i) {
      row.step();
      if (i >= 3000) most = std::max(most, row.felt(0));
    }
    EXPECT_GT(most, 1.0) << "and they feel one another again";
    EXPECT_GE(row.least_unlent(), -kRoundOff) << "seed " << seed;
  }
}

}  // namespace
}  // namespace reckon::haptics::software_stop_test
