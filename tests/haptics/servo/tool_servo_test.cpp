// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo of a device of six axes, with tools of several probes: closed forms of the wrench, and
// the energy by the device's own ledger.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <vector>

#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/tool_scenes.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::tool_servo_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using turning::floor_at;
using turning::kPeriod;
using turning::turn;

SimulatedDeviceConfig six_axes() {
  SimulatedDeviceConfig config;
  config.turn = SimulatedTurnConfig{};
  return config;
}

/// A servo on a simulated device, on a stepped clock.
class Bench {
 public:
  Bench(const SimulatedDeviceConfig& device, HandScript script, const Scene& scene,
        std::vector<Vector3d> probes, TurnScript turns = {})
      : device_(device, std::move(script), std::move(turns)) {
    ServoConfig config;
    config.probes = std::move(probes);
    servo_.emplace(device_, EffectPlan(scene), config);
  }

  const ServoSnapshot& step(nanoseconds period = kPeriod) {
    now_ += period;
    servo_->step(now_);
    EXPECT_TRUE(servo_->snapshots().update());
    least_ = std::min(least_, device_.port_work() + device_.damping_loss());
    return servo_->snapshots().read();
  }
  const ServoSnapshot& run(int steps) {
    for (int i = 1; i < steps; ++i) step();
    return step();
  }
  [[nodiscard]] SimulatedDevice& device() { return device_; }
  [[nodiscard]] const ServoLoop& servo() const { return *servo_; }
  /// Least of the port's energy input and the device's damping [J].
  [[nodiscard]] double least() const { return least_; }

 private:
  SimulatedDevice device_;
  std::optional<ServoLoop> servo_;
  nanoseconds now_{0};
  double least_ = 0.0;
};

// A bar of two probes, pressed by a hand on a floor of 500 N/m: each probe is on it, and the device
// gets their sum and r x F.
TEST(ToolServo, RendersForceAndTorqueOfEachProbe) {
  const std::vector<Vector3d> probes{{0.03, 0, -0.02}, {-0.05, 0.01, -0.02}};
  const double tilt = 0.02;
  const auto script = [&](double t) {
    HandTarget target;
    target.position = {0, 0, 0.02 - 0.004 * std::min(1.0, t)};
    return target;
  };
  const auto turns = [&](double t) {
    return DeviceTurn{turn(tilt * std::min(1.0, t), Vector3d(0, 1, 0)), Vector3d::Zero()};
  };
  Scene scene;
  scene.objects = {floor_at(0.0, 500.0)};
  SimulatedDeviceConfig config = six_axes();
  config.start = {0, 0, 0.02};
  Bench bench(config, script, scene, probes, turns);
  const ServoSnapshot& out = bench.run(3000);
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  int pressed = 0;
  for (const Vector3d& probe : probes) {
    const Vector3d lever = out.tool.orientation * probe;
    const double depth = -(out.tool.handle + lever).z();
    if (depth <= 0) continue;
    ++pressed;
    const Vector3d one(0, 0, 500.0 * depth);
    force += one;
    torque += lever.cross(one);
  }
  EXPECT_EQ(pressed, 2);
  EXPECT_GT(force.norm(), 0.2);
  EXPECT_GT(torque.norm(), 0.005);
  // The clearance of a plane is 1e-7 of the size.
  EXPECT_NEAR((out.force - force).norm(), 0.0, 1e-6);
  EXPECT_NEAR((out.tool.torque - torque).norm(), 0.0, 1e-7);
  EXPECT_NEAR((bench.device().turn()->orientation().angularDistance(out.tool.orientation)), 0.0,
              1e-9);
  const Vector3d first = out.tool.handle + out.tool.orientation * probes[0];
  EXPECT_NEAR((out.device - first).norm(), 0.0, 1e-15) << "others feel the first probe";
}

TEST(ToolServo, OneProbeEqualsAServoOfThreeAxes) {
  const auto script = [](double t) {
    HandTarget target;
    target.position = {0.01 * std::sin(3 * t), 0.004 * std::cos(5 * t), 0.008 * std::cos(9 * t)};
    return target;
  };
  Scene scene;
  scene.objects = {floor_at(0.0, 700.0)};
  SimulatedDeviceConfig three;
  Bench point(three, script, scene, {});
  Bench turning(six_axes(), script, scene, {});
  double most = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const ServoSnapshot a = point.step();
    const ServoSnapshot b = turning.step();
    most = std::max(most, a.force.norm());
    ASSERT_NEAR((a.force - b.force).norm(), 0.0, 1e-6) << i;
    ASSERT_NEAR(b.tool.torque.norm(), 0.0, 1e-12) << i;
  }
  EXPECT_GT(most, 1.0);
}

// A lever multiplies the effect of a turn: the sure stiffness falls with it.
TEST(ToolServo, SoftensWallsByTheLeversOfItsProbes) {
  const SimulatedDeviceConfig config = six_axes();
  Scene scene;
  scene.objects = {floor_at(0.0, 5000.0)};
  const double handle = Bench(config, {}, scene, {}).servo().static_stiffness_limit();
  const double b = config.damping, turning = config.turn->damping;
  for (const double lever : {0.02, 0.1, 0.3}) {
    const Bench bench(config, {}, scene, {Vector3d(lever, 0, 0)});
    const double sure = 1.0 / (1.0 / b + lever * lever / turning);
    EXPECT_LT(bench.servo().static_stiffness_limit(), handle * sure / b);
    EXPECT_GT(bench.servo().remote_stiffness_limit(), 0.85 * 0.95 * sure / 1e-3) << lever;
    EXPECT_LE(bench.servo().remote_stiffness_limit(), 0.95 * sure / 1e-3) << lever;
  }
}

TEST(ToolServo, RefusesUnsupportedTools) {
  SimulatedDevice three{SimulatedDeviceConfig{}};
  ServoConfig config;
  config.probes = {Vector3d(0.1, 0, 0)};
  EXPECT_THROW(ServoLoop(three, EffectPlan(), config), std::invalid_argument)
      << "a device without torque turns no tool";
  SimulatedDevice six{six_axes()};
  config.probes.assign(9, Vector3d::Zero());
  EXPECT_THROW(ServoLoop(six, EffectPlan(), config), std::invalid_argument);
  config.probes = {Vector3d(1.1, 0, 0)};
  EXPECT_THROW(ServoLoop(six, EffectPlan(), config), std::invalid_argument);
  SimulatedDeviceConfig stiff = six_axes();
  stiff.turn->damping = 0.0;
  EXPECT_THROW(SimulatedDevice{stiff}, std::invalid_argument);
}

// A corner of a floor and a box: probes come and go, edges, taps and turns.
Scene corner(std::mt19937& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Scene scene;
  scene.objects = {floor_at(0.0, 100.0 * std::pow(50.0, any(random)))};
  SceneObject box;
  box.shape = BoxShape{Vector3d(0.02, 0.03, 0.04)};
  box.pose.position = {0.03, 0.0, 0.02};
  box.pose.orientation = turn(any(random), Vector3d(any(random), 0.3, any(random)));
  box.effects.of<SpringDamper>() = {100.0 * std::pow(50.0, any(random)), 3.0 * any(random)};
  if (any(random) < 0.5) box.effects.declare<StickSlipFriction>() = {0.5, 0.3};
  scene.objects.push_back(box);
  return scene;
}

struct Outcome {
  double least = 0.0;      // of the device's ledger
  double stated = 0.0;     // least port energy stated by the servo
  double torque = 0.0;     // greatest
  double allowance = 0.0;  // for encoder steps, and late steps
};

// A hand that strokes, pushes and twists a tool at random, and releases it at times.
Outcome stroke(unsigned seed, bool in_steps, bool late) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  SimulatedDeviceConfig config = six_axes();
  config.damping = 0.3 + 1.5 * std::abs(any(random));
  config.turn->damping = 0.002 * std::pow(20.0, std::abs(any(random)));
  config.turn->inertia = 2e-5 * std::pow(10.0, std::abs(any(random)));
  config.turn->max_torque = 0.3;
  config.delay_samples = seed % 3 == 2 ? 1 : 0;
  config.start = {0, 0, 0.06};
  if (in_steps) {
    config.resolution = 1e-5;
    config.turn->resolution = 2e-4;
  }
  std::vector<Vector3d> probes(1 + random() % 4);
  for (Vector3d& probe : probes) probe = 0.06 * Vector3d(any(random), any(random), any(random));
  const double a = 2 + 8 * std::abs(any(random)), b = 2 + 8 * std::abs(any(random));
  const Vector3d axis(any(random), any(random), any(random));
  const auto script = [=](double t) {
    HandTarget target;
    target.position = {0.02 * std::sin(a * t), 0.02 * std::cos(b * t),
                       0.02 + 0.03 * std::cos(0.7 * a * t)};
    target.grip = std::fmod(t, 1.7) < 1.4 ? 1.0 : 0.0;
    return target;
  };
  const auto turns = [=](double t) {
    return DeviceTurn{turn(0.8 * std::sin(b * t), axis), Vector3d::Zero()};
  };
  const Scene scene = corner(random);
  Bench bench(config, script, scene, probes, turns);
  Outcome out;
  for (int i = 0; i < 4000; ++i) {
    const bool is_late = late && random() % 20 == 0;
    const ServoSnapshot& step =
        bench.step(is_late ? nanoseconds(1'000'000 + random() % 2'000'000) : kPeriod);
    EXPECT_TRUE(step.force.allFinite() && step.tool.torque.allFinite()) << i;
    out.torque = std::max(out.torque, step.tool.torque.norm());
    out.stated = step.port_energy_min;
    out.allowance = std::max(out.allowance, step.encoder_allowance + step.late_cost);
    if (testing::Test::HasFailure()) break;
  }
  out.least = bench.least();
  return out;
}

TEST(ToolServo, NeverGivesEnergyByTheDevicesOwnLedger) {
  double least = 0.0, torque = 0.0;
  for (unsigned seed = 1; seed <= test::tries(20U, 60U); ++seed) {
    const Outcome one = stroke(seed, false, false);
    EXPECT_GE(one.least, -1e-9) << "seed " << seed;
    EXPECT_GE(one.stated, -1e-9) << "seed " << seed;
    least = std::min(least, one.least);
    torque = std::max(torque, one.torque);
  }
  EXPECT_GT(torque, 0.05) << "nothing was tried";
  std::printf("least %.3g J, greatest torque %.3g N m\n", least, torque);
}

TEST(ToolServo, KeepsItsLedgerWithEncodersAndLateSteps) {
  double worst = 0.0;
  for (unsigned seed = 1; seed <= test::tries(20U, 60U); ++seed) {
    const Outcome one = stroke(seed, seed % 2 == 0, true);
    EXPECT_GE(one.least, -one.allowance - 1e-9) << "seed " << seed;
    worst = std::min(worst, one.least + one.allowance);
  }
  std::printf("least beyond the allowance %.3g J\n", worst);
}

TEST(ToolServo, CutsTheForceOfAnInvalidPose) {
  class Broken : public SimulatedDevice {
   public:
    using SimulatedDevice::SimulatedDevice;
    DeviceSample read(nanoseconds now) noexcept override {
      DeviceSample sample = SimulatedDevice::read(now);
      if (broken) sample.turn->orientation.coeffs() *= 1.5;
      return sample;
    }
    bool broken = false;
  };
  Broken device(six_axes());
  Scene scene;
  scene.objects = {floor_at(0.001, 500.0)};
  ServoLoop servo(device, EffectPlan(scene), {});
  nanoseconds now{0};
  const auto step = [&] {
    servo.step(now += kPeriod);
    EXPECT_TRUE(servo.snapshots().update());
    return servo.snapshots().read();
  };
  for (int i = 0; i < 1000; ++i) step();
  EXPECT_GT(step().force.norm(), 0.1);
  device.broken = true;
  EXPECT_GT(step().tally.failed, 0u);
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(step().force.norm(), 0.0);
  EXPECT_GT(step().trips, 0u);
  device.broken = false;
  for (int i = 0; i < 1500; ++i) step();
  EXPECT_GT(step().force.norm(), 0.1) << "and comes back by itself";
}

}  // namespace
}  // namespace reckon::haptics::tool_servo_test
