// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scaled, mirrored or clutched device does the same work on both sides.
#include "reckon/haptics/devices/mapped_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/safety.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::mapped_device_test {
namespace {

using bench::floor;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr double kRoundOff = 1e-9;  // [J]

// Returns the configured values and keeps the written ones.
class Probe : public HapticDevice {
 public:
  [[nodiscard]] DeviceLimits limits() const noexcept override { return given; }
  [[nodiscard]] DeviceSample read(nanoseconds) noexcept override { return sample; }
  void write(const Vector3d& f, nanoseconds) noexcept override { force = f; }
  void write_wrench(const Vector3d& f, const Vector3d& t, nanoseconds) noexcept override {
    force = f;
    torque = t;
  }
  DeviceLimits given;
  DeviceSample sample;
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
};

class Draws {
 public:
  explicit Draws(unsigned seed) : random_(seed) {}
  double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  Vector3d vector() { return {any(-1, 1), any(-1, 1), any(-1, 1)}; }
  Quaterniond orientation() {
    return Quaterniond(any(-1, 1), any(-1, 1), any(-1, 1), any(-1, 1)).normalized();
  }

 private:
  std::mt19937 random_;
};

TEST(MappedDevice, PreservesPowerAtAnyScaleAndMirror) {
  Draws draws(7);
  for (int i = 0; i < 2000; ++i) {
    HandMapping mapping;
    mapping.scale = std::pow(10.0, draws.any(-1, 1));
    mapping.mirrored = i % 2 == 1;
    Probe device;
    device.sample.ok = device.sample.has_velocity = true;
    device.sample.velocity = draws.vector();
    device.sample.turn = {draws.orientation(), draws.vector()};
    MappedDevice hand(device, mapping);
    const DeviceSample sample = hand.read(0ns);
    const Vector3d force = draws.vector(), torque = draws.vector();
    hand.write_wrench(force, torque, 0ns);
    EXPECT_NEAR(force.dot(sample.velocity), device.force.dot(device.sample.velocity), 1e-12);
    EXPECT_NEAR(torque.dot(sample.turn->rate), device.torque.dot(device.sample.turn->rate), 1e-12);
    hand.write(force, 0ns);
    EXPECT_NEAR(force.dot(sample.velocity), device.force.dot(device.sample.velocity), 1e-12);
  }
}

// The reported rate is the rate of the reported orientation.
TEST(MappedDevice, ScalesDampingAndResolutionOfSamples) {
  Probe device;
  device.given.damping = 2.0;
  device.given.resolution = 1e-4;
  device.sample.ok = true;
  device.sample.damping = device.given.damping;
  device.sample.resolution = device.given.resolution;
  device.sample.held = 0.5;
  HandMapping mapping;
  mapping.scale = 4.0;
  MappedDevice hand(device, mapping);
  const DeviceSample sample = hand.read(0ns);
  EXPECT_EQ(sample.damping, hand.limits().damping);
  EXPECT_EQ(sample.resolution, hand.limits().resolution);
  EXPECT_EQ(sample.held, 0.5);
}

TEST(MappedDevice, MirroredToolTurnsAtTheReportedRate) {
  Draws draws(3);
  HandMapping mapping;
  mapping.mirrored = true;
  for (int i = 0; i < 200; ++i) {
    Probe device;
    device.sample.ok = true;
    const Quaterniond before = draws.orientation();
    const Vector3d rate = draws.vector();
    device.sample.turn = {before, rate};
    MappedDevice hand(device, mapping);
    const DeviceSample first = hand.read(0ns);
    constexpr double kStep = 1e-6;  // [s]
    device.sample.turn->orientation =
        Quaterniond(Eigen::AngleAxisd(kStep * rate.norm(), rate.normalized())) * before;
    const DeviceSample second = hand.read(1us);
    const Eigen::AngleAxisd way(second.turn->orientation * first.turn->orientation.conjugate());
    EXPECT_LT((way.angle() * way.axis() / kStep - first.turn->rate).norm(), 1e-6);
    // Seen in a mirror: the image of any arm of the tool is the arm of the image.
    const Vector3d arm = draws.vector();
    EXPECT_LT((mirrored(Vector3d(before * arm)) - first.turn->orientation * mirrored(arm)).norm(),
              1e-12);
  }
}

// 0.95 x 2 b/T is 1900 N/m at 1 N s/m, walls get 3/4 of it; a scale of two gives a quarter of it in
// S.
TEST(MappedDevice, WallStiffnessAtTheHandleIsTheDevices) {
  for (const double scale : {0.5, 1.0, 2.0, 5.0}) {
    SimulatedDevice device((SimulatedDeviceConfig()));
    MappedDevice hand(device, {scale});
    const ServoLoop servo(hand, EffectPlan(floor(1e5)), {});
    EXPECT_NEAR(servo.static_stiffness_limit() * scale * scale, 0.75 * 1900, 1e-9);
    EXPECT_NEAR(servo.force_limit() * scale, 10.0, 1e-12) << "at the handle";
  }
}

TEST(MappedDevice, RefusesInvalidScalesAndButtons) {
  SimulatedDevice device((SimulatedDeviceConfig()));
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(MappedDevice(device, {bad}), std::invalid_argument);
  for (const int bad : {-1, 32})
    EXPECT_THROW(MappedDevice(device, {1.0, false, bad}), std::invalid_argument);
}

TEST(MappedDevice, ScalesAndMirrorsItsWorkSpace) {
  DeviceLimits limits;
  limits.workspace_min = {-0.1, -0.2, -0.3};
  limits.workspace_max = {0.4, 0.5, 0.6};
  const DeviceLimits there = mapped(limits, {2.0, true});
  EXPECT_EQ(there.workspace_min, Vector3d(-0.8, -0.4, -0.6));
  EXPECT_EQ(there.workspace_max, Vector3d(0.2, 1.0, 1.2));
}

// 30 mm to the left, back with the clutch, and again: the hand is 60 mm to the left.
TEST(MappedDevice, ClutchExtendsTheReachOfTheHandle) {
  Probe device;
  device.sample.ok = true;
  MappedDevice hand(device, {1.0, false, 0});
  nanoseconds now{0};
  const auto go = [&](double from, double to, bool clutched, double hand_from, double hand_to) {
    for (int i = 0; i <= 30; ++i) {
      const double share = i / 30.0;
      device.sample.position.x() = from + share * (to - from);
      device.sample.buttons = clutched ? 1 : 0;
      const DeviceSample sample = hand.read(now += 1ms);
      EXPECT_NEAR(sample.position.x(), hand_from + share * (hand_to - hand_from), 1e-12) << i;
      EXPECT_EQ(sample.enabled, !clutched);
    }
  };
  go(0.0, -0.03, false, 0.0, -0.03);
  go(-0.03, 0.0, true, -0.03, -0.03);
  go(0.0, -0.03, false, -0.03, -0.06);
  go(-0.03, 0.02, true, -0.06, -0.06);
  go(0.02, 0.02, false, -0.06, -0.06);
}

// Forces in transit to the handle work on its real motion.
TEST(MappedDevice, HandStopsWhenTheLastForceHasArrived) {
  Probe device;
  device.sample.ok = true;
  device.given.delay_samples = 3;
  MappedDevice hand(device, {1.0, false, 0});
  (void)hand.read(0ns);
  device.sample.buttons = 1;
  for (int i = 0; i < 10; ++i) {
    device.sample.position.z() = 0.001 * (i + 1);
    const double told = hand.read(std::chrono::milliseconds(i + 1)).position.z();
    EXPECT_NEAR(told, 0.001 * std::min(i + 1, 4), 1e-12) << i;
  }
}

// A hand that presses, slides, clutches at random and gets its forces late: by the device's ledger.
TEST(MappedDevice, MakesNoEnergyAtAnyScaleOrClutch) {
  int felt = 0;  // the clutch may move a hand out of reach of the floor
  for (unsigned seed = 1; seed <= 24; ++seed) {
    Draws draws(seed);
    SimulatedDeviceConfig config;
    config.mass = 0.05 + draws.any(0, 0.4);
    config.hand_stiffness = 100 + draws.any(0, 900);
    config.delay_samples = static_cast<int>(seed % 3);
    config.friction = seed % 2 == 0 ? 0.2 : 0.0;
    HandMapping mapping;
    mapping.scale = std::pow(4.0, draws.any(-1, 1));
    mapping.mirrored = seed % 4 < 2;
    mapping.clutch_button = 5;
    config.start.z() = 0.02 / mapping.scale;
    const double waves = 1 + draws.any(0, 9), scale = mapping.scale;
    SimulatedDevice device(config, [=](double t) {
      HandTarget target;
      target.position = {0.02 * std::sin(0.7 * waves * t), 0.0,
                         0.01 * (0.2 + std::cos(waves * t)) / scale};
      return target;
    });
    MappedDevice hand(device, mapping);
    ServoLoop servo(hand, EffectPlan(floor(200 + draws.any(0, 2000), draws.any(0, 0.3))), {});
    double least = 0.0, peak = 0.0;
    int until_change = 100;
    bool clutched = false;
    for (auto now = 0ns; now < 12s; now += 1ms) {
      if (--until_change == 0) {
        clutched = !clutched;
        device.press(clutched ? 1U << 5 : 0);
        until_change = 1 + static_cast<int>(draws.any(0, clutched ? 150 : 400));
      }
      servo.step(now);
      servo.snapshots().update();
      const ServoSnapshot& s = servo.snapshots().read();
      const double truth = device.port_work() + device.damping_loss();
      least = std::min(least, truth + s.loan);
      peak = std::max(peak, device.force().norm());
      ASSERT_LE(s.port_energy, truth + kRoundOff) << "seed " << seed << ": the meter";
    }
    EXPECT_GE(least, -kRoundOff) << "seed " << seed;
    felt += peak > 0.3 ? 1 : 0;
  }
  EXPECT_GE(felt, 16);
}

TEST(MappedDevice, ForceReturnsBelowTheRampAfterTheClutch) {
  SimulatedDeviceConfig config;
  config.start.z() = 0.01;
  SimulatedDevice device(config, [](double t) {
    HandTarget target;
    target.position.z() = std::max(-0.03, 0.01 - 0.05 * t);
    return target;
  });
  MappedDevice hand(device, {1.0, false, 0});
  ServoLoop servo(hand, EffectPlan(floor(800)), {});
  nanoseconds now{0};
  const auto run = [&](std::chrono::milliseconds time) {
    for (const nanoseconds end = now + time; now < end; now += 1ms) servo.step(now);
    return device.force().norm();
  };
  EXPECT_GT(run(3s), 2.0);
  device.press(1);
  EXPECT_EQ(run(1ms), 0.0) << "in its step";
  EXPECT_EQ(run(500ms), 0.0);
  device.press(0);
  for (int step = 1; step <= Safety::kRampSteps; ++step)
    EXPECT_LE(run(1ms), 10.0 * step / Safety::kRampSteps + kRoundOff);
}

}  // namespace
}  // namespace reckon::haptics::mapped_device_test
