// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/simulated_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "reckon/haptics/servo/motion_filter.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

TEST(SimulatedDevice, BooksAllItsEnergy) {
  SimulatedDeviceConfig config;
  SimulatedDevice device(config, [](double t) {
    HandTarget hand;
    hand.position = {0.02 * std::sin(9 * t), 0.01 * std::sin(5 * t), 0};
    return hand;
  });
  double drift = 0;
  for (auto now = 0ns; now < 3s; now += 1ms) {
    (void)device.read(now);
    const double balance =
        device.hand_work() - device.port_work() - device.damping_loss() - device.kinetic_energy();
    drift = std::max(drift, std::abs(balance));
    const double t = 1e-9 * static_cast<double>(now.count());
    device.write({2 * std::sin(20 * t), std::cos(15 * t), -1}, now);
  }
  // Semi-implicit Euler books 1/2 m |dv|^2 too much input per substep: 1 % here.
  EXPECT_LT(drift, 0.01 * device.damping_loss());
}

TEST(SimulatedDevice, DissipatesAtLeastTheGatesDamping) {
  SimulatedDeviceConfig config;
  SimulatedDevice device(config, [](double t) {
    HandTarget hand;
    hand.push = {2 * std::sin(40 * t), std::cos(300 * t), 0};
    return hand;
  });
  Vector3d last = device.position();
  double lost = 0;
  for (auto now = 0ns; now < 1s; now += 1ms) {
    const DeviceSample sample = device.read(now);
    const double counted = config.damping * (sample.position - last).squaredNorm() / 1e-3;
    EXPECT_GE(device.damping_loss() - lost, counted * (1 - 1e-12));
    lost = device.damping_loss();
    last = sample.position;
    device.write(Vector3d::Zero(), now);
  }
}

// 0.3 N of dry friction: 0.29 N do not move it, and from 0.5 m/s the handle of 0.1 kg slides for v
// / (F / m) = 0.167 s and v^2 / (2 F / m) = 41.7 mm.
TEST(SimulatedDevice, StopsByItsDryFriction) {
  SimulatedDeviceConfig config;
  config.damping = 0.0;
  config.friction = 0.3;
  config.hand_stiffness = config.hand_damping = 0.0;
  SimulatedDevice device(config);
  for (auto now = 0ms; now < 100ms; now += 1ms) {
    (void)device.read(now);
    device.write({0.29, 0, 0}, now);
  }
  EXPECT_TRUE(device.position().isZero(0.0));
  device.restart(Vector3d::Zero(), {0.5, 0, 0}, 100ms);
  double rests_at = 0.0;
  for (auto now = 100ms; now < 400ms; now += 1ms) {
    (void)device.read(now);
    if (device.velocity().norm() > 0) rests_at = 1e-3 * static_cast<double>(now.count() - 100);
  }
  EXPECT_NEAR(rests_at, 0.5 / 3.0, 0.002);
  EXPECT_NEAR(device.position().x(), 0.25 / 6.0, 1e-4);
}

TEST(SimulatedDevice, RestartsElsewhereOnTheSameHandPath) {
  double asked = 0;
  SimulatedDeviceConfig config;
  config.delay_samples = 2;
  SimulatedDevice device(config, [&asked](double t) {
    asked = t;
    return HandTarget{};
  });
  for (auto now = 0ns; now < 100ms; now += 1ms) {
    (void)device.read(now);
    device.write({1, 0, 0}, now);
  }
  device.restart({0.1, 0.2, 0.3}, {0, 1, 0}, 5s);
  EXPECT_EQ(device.position(), Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(device.velocity(), Vector3d(0, 1, 0));
  EXPECT_EQ(device.force().norm(), 0);
  EXPECT_EQ(device.port_work(), 0);
  EXPECT_EQ(device.damping_loss(), 0);
  EXPECT_EQ(device.hand_work(), 0);
  device.write({5, 0, 0}, 5s);
  EXPECT_EQ(device.force().norm(), 0);  // the pending forces are dropped, this one has not arrived
                                        // yet
  const DeviceSample sample = device.read(5s + 1ms);
  EXPECT_FALSE(sample.watchdog);
  EXPECT_NEAR(asked, 5.0009, 1e-9);
}

TEST(SimulatedDevice, RestsAtTheBalanceOfHandAndForce) {
  SimulatedDeviceConfig config;
  config.hand_stiffness = 100;
  SimulatedDevice device(config);
  for (auto now = 0ns; now < 3s; now += 1ms) {
    (void)device.read(now);
    device.write({0, 0, 2.0}, now);
  }
  EXPECT_NEAR(device.position().z(), 0.02, 1e-9);
}

TEST(SimulatedDevice, DropsTheForceTenMillisecondsAfterAWrite) {
  SimulatedDevice device(SimulatedDeviceConfig{});
  (void)device.read(0ns);
  device.write({1, 0, 0}, 0ns);
  EXPECT_FALSE(device.read(10ms).watchdog);
  EXPECT_EQ(device.force().x(), 1.0);
  const DeviceSample late = device.read(11ms);
  EXPECT_TRUE(late.watchdog);
  EXPECT_EQ(device.force().norm(), 0.0);
  EXPECT_FALSE(device.read(12ms).watchdog);
}

TEST(SimulatedDevice, AppliesAForceAfterItsDelayInWrites) {
  for (const int delay : {0, 1, 3, 1000}) {
    SimulatedDeviceConfig config;
    config.delay_samples = delay;
    SimulatedDevice device(config);
    EXPECT_EQ(device.limits().delay_samples, delay);
    for (int i = 1; i < 2100; ++i) {
      const auto now = i * 1ms;
      (void)device.read(now);
      device.write({0, 0, 1e-3 * i}, now);
      ASSERT_EQ(device.force().z(), i > delay ? 1e-3 * (i - delay) : 0.0) << delay << ' ' << i;
    }
  }
}

// A held force F on a handle of mass m: x = F t^2 / 2m, from its arrival.
TEST(SimulatedDevice, MovesItsHandleWhenTheForceArrives) {
  SimulatedDeviceConfig config;
  config.delay_samples = 5;
  config.damping = 0;
  config.hand_stiffness = config.hand_damping = 0;
  SimulatedDevice device(config);
  for (auto now = 0ms; now <= 5ms; now += 1ms) {
    EXPECT_EQ(device.read(now).position, Vector3d::Zero()) << "the first force is under way";
    device.write({0.1, 0, 0}, now);
  }
  (void)device.read(15ms);
  EXPECT_NEAR(device.position().x(), 0.1 * 0.01 * 0.01 / (2 * config.mass), 1e-6);
}

TEST(SimulatedDevice, WatchdogAndCableDropPendingForces) {
  SimulatedDeviceConfig config;
  config.delay_samples = 4;
  for (const bool cable : {false, true}) {
    SimulatedDevice device(config);
    (void)device.read(0ms);
    device.write({1, 0, 0}, 0ms);
    if (cable) {
      device.plug(false);
      device.plug(true);
    } else {
      EXPECT_TRUE(device.read(11ms).watchdog) << "a force was held, though not yet at the handle";
    }
    for (auto now = 12ms; now < 30ms; now += 1ms) {
      (void)device.read(now);
      device.write(Vector3d::Zero(), now);
      EXPECT_EQ(device.force().norm(), 0.0);
    }
  }
}

TEST(SimulatedDevice, RefusesDelaysBeyondItsLimit) {
  SimulatedDeviceConfig config;
  for (const int delay : {-1, SimulatedDevice::kMostDelay + 1}) {
    config.delay_samples = delay;
    EXPECT_THROW(SimulatedDevice{config}, std::invalid_argument);
  }
}

TEST(SimulatedDevice, FailsReadsAndReleasesWhileUnplugged) {
  SimulatedDevice device(SimulatedDeviceConfig{});
  (void)device.read(0ns);
  device.write({1, 0, 0}, 0ns);
  device.plug(false);
  EXPECT_FALSE(device.read(1ms).ok);
  device.write({1, 0, 0}, 1ms);
  EXPECT_EQ(device.force().norm(), 0.0);
  device.plug(true);
  EXPECT_TRUE(device.read(2ms).ok);
}

TEST(SimulatedDevice, RefusesImpossibleMassesByName) {
  SimulatedDeviceConfig config;
  config.mass = 0;
  try {
    SimulatedDevice device(config);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("mass"), std::string::npos);
  }
}

TEST(SimulatedDevice, AllocatesNothingWhileRunning) {
  SimulatedDeviceConfig config;
  config.delay_samples = 7;
  SimulatedDevice device(config, [](double t) {
    HandTarget hand;
    hand.position.x() = 0.01 * t;
    return hand;
  });
  const test::AllocationGuard guard;
  for (auto now = 0ns; now < 100ms; now += 1ms) {
    (void)device.read(now);
    device.write(Vector3d::UnitX(), now);
  }
  EXPECT_EQ(guard.count(), 0u);
}

TEST(MotionFilter, IsExactForConstantAccelerationAtUnevenTimes) {
  MotionFilter filter;
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> jitter(0.5e-3, 3e-3);
  double t = 1000.0;
  for (int i = 0; i < 200; ++i, t += jitter(rng)) {
    const double s = t - 1000.0;
    filter.add({0.1 * s, 1 - 2 * s * s, 3}, t);
    if (i < 3) continue;
    EXPECT_NEAR(filter.velocity().x(), 0.1, 1e-7);
    EXPECT_NEAR(filter.velocity().y(), -4 * s, 1e-7);
    EXPECT_NEAR(filter.acceleration().y(), -4, 1e-3);
  }
}

TEST(MotionFilter, IsSmoothOnAFortyOneMicrometreEncoder) {
  MotionFilter filter;
  double worst_v = 0, square_v = 0, square_a = 0;
  int n = 0;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * 1e-3;
    const double w = 2 * 3.14159265358979 * 1.0;
    const double x = 0.02 * std::sin(w * t);
    filter.add({std::round(x / 41e-6) * 41e-6, 0, 0}, t);
    if (i < 100) continue;
    const double dv = filter.velocity().x() - 0.02 * w * std::cos(w * t);
    const double da = filter.acceleration().x() + 0.02 * w * w * std::sin(w * t);
    worst_v = std::max(worst_v, std::abs(dv));
    square_v += dv * dv;
    square_a += da * da;
    ++n;
  }
  std::printf("1 Hz, 20 mm, 41 um: velocity rms %.2g worst %.2g m/s, acceleration rms %.2g m/s^2\n",
              std::sqrt(square_v / n), worst_v, std::sqrt(square_a / n));
  EXPECT_LT(std::sqrt(square_v / n), 0.0015);
  EXPECT_LT(std::sqrt(square_a / n), 0.12);
}

TEST(MotionFilter, IgnoresRepeatedTimesAndNonFinitePositions) {
  MotionFilter filter;
  for (int i = 0; i < 50; ++i) {
    filter.add({1e-3 * i, 0, 0}, 1e-3 * i);
    filter.add({5, 5, 5}, 1e-3 * i);
    filter.add({std::nan(""), 0, 0}, 1e-3 * i + 5e-4);
  }
  EXPECT_NEAR(filter.velocity().x(), 1.0, 1e-9);
}

}  // namespace
}  // namespace reckon::haptics
