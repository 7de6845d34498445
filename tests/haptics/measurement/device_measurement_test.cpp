// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The properties of a device are found by small pushes; an unexpected event ends them.
#include "reckon/haptics/measurement/device_measurement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>

#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

struct Modelled {
  const char* name;
  double mass, damping, friction, resolution;
  int delay;  // [ms]
  double max_force;
};

SimulatedDeviceConfig config_of(const Modelled& one) {
  SimulatedDeviceConfig config;
  config.mass = one.mass;
  config.damping = one.damping;
  config.friction = one.friction;
  config.resolution = one.resolution;
  config.delay_samples = one.delay;
  config.max_force = one.max_force;
  config.hand_stiffness = config.hand_damping = 0.0;  // nobody holds it
  return config;
}

using Spoil = std::function<void(int, DeviceSample&)>;

// Delay of the host's call of step k.
using Lateness = std::function<std::chrono::nanoseconds(int)>;

struct Outcome {
  MeasurementProblem problem;
  std::optional<MeasuredDevice> result;
  double most_push;  // [N]
};

// Runs to the end. @param spoil changes a reading
Outcome measure(HapticDevice& device, const Spoil& spoil = nullptr,
                const Lateness& late = nullptr) {
  DeviceMeasurement run(device.limits(), 1ms);
  Vector3d last = Vector3d::Zero();
  for (int k = 0; k < 300'000 && !run.is_done(); ++k) {
    const auto now = std::chrono::milliseconds(k) + (late ? late(k) : 0ns);
    DeviceSample sample = device.read(now);
    if (spoil) spoil(k, sample);
    last = run.step(sample, now);
    device.write(last, now);
    if (run.needs_judging()) run.judge();
  }
  EXPECT_TRUE(run.is_done());
  EXPECT_TRUE(last.isZero(0.0)) << "it ends without a force";
  return {run.problem(), run.result(), run.most_push()};
}

TEST(DeviceMeasurement, FindsDampingAndDelayWithinTenPerCent) {
  const Modelled devices[] = {
      {"like a Falcon", 0.25, 0.3, 0.3, 90e-6, 6, 8.0},
      {"like a Polhem", 0.28, 0.5, 0.5, 70e-6, 2, 5.0},
      {"like a pen", 0.045, 0.2, 0.26, 55e-6, 2, 3.3},
      {"like a pen on capstans", 0.045, 0.2, 0.06, 23e-6, 1, 7.9},
      {"light and fine", 0.05, 1.0, 0.05, 10e-6, 1, 10.0},
      {"heavy and late", 0.8, 3.0, 0.5, 30e-6, 20, 20.0},
      {"exact, without dry friction", 0.1, 1.0, 0.0, 0.0, 4, 10.0},
  };
  for (const Modelled& one : devices) {
    SimulatedDevice device(config_of(one));
    const Outcome run = measure(device);
    ASSERT_EQ(run.problem, MeasurementProblem::none) << one.name;
    const MeasuredDevice& found = *run.result;
    std::printf(
        "%s: b %.3f of %.3f N s/m (+- %.3f), delay %.2f of %d ms, dry %.3f of %.3f N, "
        "mass %.3f of %.3f kg, steps %.1f of %.1f um, at most %.2f N\n",
        one.name, found.damping, one.damping, found.damping_error, 1e3 * found.delay, one.delay,
        found.friction, one.friction, found.mass, one.mass, 1e6 * found.resolution,
        1e6 * one.resolution, run.most_push);
    EXPECT_NEAR(found.damping, one.damping, 0.1 * one.damping) << one.name;
    EXPECT_NEAR(1e3 * found.delay, one.delay, 0.1 * one.delay + 1e-9) << one.name;
    EXPECT_NEAR(found.friction, one.friction, 0.1 * one.friction + 0.01) << one.name;
    EXPECT_NEAR(found.mass, one.mass, 0.1 * one.mass) << one.name;
    EXPECT_NEAR(found.resolution, one.resolution, 0.01 * one.resolution) << one.name;
    EXPECT_LE(run.most_push, DeviceMeasurement::kMostPush + 1e-12);
    EXPECT_LE(run.most_push, 0.4 * one.max_force + 1e-12);
  }
}

// Gives energy to a hand that moves it.
class ActiveDevice : public SimulatedDevice {
 public:
  ActiveDevice(const SimulatedDeviceConfig& config, double gives)
      : SimulatedDevice(config), gives_(gives) {}
  void write(const Vector3d& force, std::chrono::nanoseconds now) noexcept override {
    SimulatedDevice::write(force + gives_ * velocity(), now);
  }

 private:
  double gives_;  // [N s/m]
};

TEST(DeviceMeasurement, RefusesADeviceThatGeneratesEnergy) {
  for (const double gives : {1.3, 1.6, 3.0}) {
    const Modelled one{"", 0.2, 1.0, 0.0, 20e-6, 0, 10.0};
    ActiveDevice device(config_of(one), gives);
    const Outcome run = measure(device);
    const bool seen =
        run.problem == MeasurementProblem::active || run.problem == MeasurementProblem::restless ||
        run.problem == MeasurementProblem::place || run.problem == MeasurementProblem::speed;
    EXPECT_TRUE(seen) << gives << ": " << static_cast<int>(run.problem);
    EXPECT_FALSE(run.result);
  }
}

const Modelled kGood{"good", 0.2, 1.0, 0.1, 20e-6, 1, 10.0};

TEST(DeviceMeasurement, RefusesADeviceWithFailingReadings) {
  SimulatedDevice device(config_of(kGood));
  const Outcome run =
      measure(device, [](int k, DeviceSample& sample) { sample.ok = k < 2000 || k > 2003; });
  EXPECT_EQ(run.problem, MeasurementProblem::readings);
}

TEST(DeviceMeasurement, FewFailedReadingsCostNoAccuracy) {
  SimulatedDevice device(config_of(kGood));
  const Outcome run =
      measure(device, [](int k, DeviceSample& sample) { sample.ok = k % 1700 != 1000; });
  ASSERT_EQ(run.problem, MeasurementProblem::none);
  EXPECT_NEAR(run.result->damping, 1.0, 0.1);
}

TEST(DeviceMeasurement, RefusesTooLongADelay) {
  Modelled late = kGood;
  for (const int delay : {60, 80, 100}) {
    late.delay = delay;
    SimulatedDevice device(config_of(late));
    EXPECT_EQ(measure(device).problem, MeasurementProblem::late) << delay;
  }
}

TEST(DeviceMeasurement, RefusesAHeldOrStuckHandle) {
  SimulatedDeviceConfig held = config_of(kGood);
  held.hand_stiffness = 300;
  held.hand_damping = 3;
  SimulatedDevice in_hand(held);
  const MeasurementProblem problem = measure(in_hand).problem;
  EXPECT_TRUE(problem == MeasurementProblem::unlike || problem == MeasurementProblem::stuck ||
              problem == MeasurementProblem::active)
      << static_cast<int>(problem);
  Modelled stiff = kGood;
  stiff.friction = 5.0;
  SimulatedDevice rusty(config_of(stiff));
  EXPECT_EQ(measure(rusty).problem, MeasurementProblem::stuck);
}

TEST(DeviceMeasurement, EndsAtOnceAtEachUnexpectedEvent) {
  SimulatedDevice device(config_of(kGood));
  EXPECT_EQ(measure(device, [](int k, DeviceSample& sample) { sample.enabled = k < 700; }).problem,
            MeasurementProblem::switch_off);
  SimulatedDevice other(config_of(kGood));
  EXPECT_EQ(measure(other,
                    [](int k, DeviceSample& sample) {
                      if (k > 900) sample.position.x() += 0.1;
                    })
                .problem,
            MeasurementProblem::speed);
  SimulatedDevice drifts(config_of(kGood));
  EXPECT_EQ(
      measure(drifts, [](int k, DeviceSample& sample) { sample.position.x() += 5e-6 * k; }).problem,
      MeasurementProblem::restless);
}

// At intervals one step is late by this time; the next one is on time again.
Lateness each(int steps, std::chrono::nanoseconds late) {
  return [=](int k) { return k % steps == 0 ? late : 0ns; };
}

TEST(DeviceMeasurement, OccasionalLateStepsDoNoHarm) {
  Modelled one = kGood;
  for (const int delay : {0, 6}) {
    one.delay = delay;
    SimulatedDevice device(config_of(one));
    const Outcome run = measure(device, nullptr, delay == 0 ? each(53, 900us) : each(61, 700us));
    ASSERT_EQ(run.problem, MeasurementProblem::none) << delay;
    std::printf("delay %d: b %.3f, delay %.2f ms\n", delay, run.result->damping,
                1e3 * run.result->delay);
    EXPECT_NEAR(run.result->damping, 1.0, 0.1) << delay;
    EXPECT_NEAR(1e3 * run.result->delay, delay, 0.1 * delay + 0.1);
  }
}

TEST(DeviceMeasurement, RefusesATooBusyHost) {
  // More than one step in fifty.
  SimulatedDevice device(config_of(kGood));
  EXPECT_EQ(measure(device, nullptr, each(45, 700us)).problem, MeasurementProblem::busy);
  // One step that is very late in a push.
  SimulatedDevice other(config_of(kGood));
  const Lateness once = [](int k) { return k > 500 && k < 506 ? 1ms * (506 - k) : 0ns; };
  EXPECT_EQ(measure(other, nullptr, once).problem, MeasurementProblem::busy);
}

// Only the device's own clock gives the duration of a displacement.
TEST(DeviceMeasurement, UsesTheDevicesOwnClock) {
  class Clocked : public SimulatedDevice {
   public:
    using SimulatedDevice::SimulatedDevice;
    // Reads only every second step, and then both displacements at once.
    DeviceSample read(std::chrono::nanoseconds now) noexcept override {
      const bool is_new = !last_ || now - at_ > 1'900us;
      if (is_new) {
        const auto took = last_ ? now - at_ : 0ns;
        last_ = SimulatedDevice::read(now);
        last_->took = took;
        at_ = now;
      } else {
        last_->took = 0ns;
      }
      return *last_;
    }

   private:
    std::optional<DeviceSample> last_;
    std::chrono::nanoseconds at_{0};
  };
  Modelled one = kGood;
  one.delay = 0;
  Clocked device(config_of(one));
  const Outcome run = measure(device);
  ASSERT_EQ(run.problem, MeasurementProblem::none);
  std::printf("b %.3f, delay %.2f ms\n", run.result->damping, 1e3 * run.result->delay);
  EXPECT_NEAR(run.result->damping, 1.0, 0.05);
}

// A board of one axis or two: the others never move.
TEST(DeviceMeasurement, PushesOnlyExistingAxes) {
  for (const DeviceMeasurement::Axes axes :
       {DeviceMeasurement::Axes{true, false, false}, DeviceMeasurement::Axes{false, true, true}}) {
    SimulatedDevice device(config_of(kGood));
    DeviceMeasurement run(device.limits(), 1ms, axes);
    Vector3d pushed = Vector3d::Zero();
    for (int k = 0; k < 300'000 && !run.is_done(); ++k) {
      const auto now = std::chrono::milliseconds(k);
      const Vector3d force = run.step(device.read(now), now);
      pushed = pushed.cwiseMax(force.cwiseAbs());
      device.write(force, now);
      if (run.needs_judging()) run.judge();
    }
    ASSERT_EQ(run.problem(), MeasurementProblem::none);
    EXPECT_NEAR(run.result()->damping, 1.0, 0.1);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(pushed(axis) > 0, axes[static_cast<std::size_t>(axis)]) << axis;
  }
}

TEST(DeviceMeasurement, GivesNoForceWhileAnAxisIsJudged) {
  SimulatedDevice device(config_of(kGood));
  DeviceMeasurement run(device.limits(), 1ms);
  int k = 0;
  for (; k < 300'000 && !run.needs_judging(); ++k) {
    const auto now = std::chrono::milliseconds(k);
    device.write(run.step(device.read(now), now), now);
  }
  ASSERT_TRUE(run.needs_judging());
  DeviceSample gone;
  for (int i = 0; i < 500; ++i, ++k)
    EXPECT_TRUE(run.step(gone, std::chrono::milliseconds(k)).isZero(0))
        << "no reading is looked at";
  run.judge();
  EXPECT_FALSE(run.is_done());
  EXPECT_EQ(run.judged(), 1U);
}

}  // namespace
}  // namespace reckon::haptics
