// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices on USB are measured through the real libusb; a model answers the kernel's calls: damping
// and the chain's delay are found, and each fault removes the force. All time is the model's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/measurement/measuring_servo.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::measured_usb_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using ::testing::Contains;
using ::testing::HasSubstr;

struct Falcon {
  using Model = test::FalconModel;
  using Options = test::FalconModelOptions;
  static std::unique_ptr<UsbDriver> driver() {
    return std::make_unique<FalconDriver>(FalconFirmware{});
  }
  static const UsbFacts& facts() { return falcon_facts(); }
};

struct Polhem {
  using Model = test::PolhemModel;
  using Options = test::PolhemModelOptions;
  static std::unique_ptr<UsbDriver> driver() { return std::make_unique<PolhemDriver>(); }
  static const UsbFacts& facts() { return polhem_facts(); }
};

template <class Kind>
DeviceLimits limits_of(int delay) {
  UsbSettings settings;
  settings.damping = Kind::facts().assumed_damping;
  settings.chain = milliseconds(delay);
  return usb_limits(Kind::facts(), settings);
}

/// Plugged in, with the measuring servo instead of its own.
template <class Kind>
class Measured : public test::PluggedDevice<typename Kind::Model> {
 public:
  explicit Measured(const typename Kind::Options& options, int delay = 6)
      : test::PluggedDevice<typename Kind::Model>(
            options, [](double) { return Vector3d(0, 0.01, 0); }, Kind::driver(),
            limits_of<Kind>(delay)),
        measuring(this->device, stop, milliseconds(1), &this->device) {
    this->model.beside([this](nanoseconds now) {
      this->tend();
      if (now < next_) return;
      next_ += milliseconds(1);
      if (before_step) before_step(now);
      if (servo_runs) measuring.step(now);
    });
  }

  // Its loop sends a last zero force, which takes time.
  ~Measured() { this->model.beside(nullptr); }

  /// @return whether it reached this stage
  bool reach(MeasuringStage stage, nanoseconds longest = seconds(20)) {
    const nanoseconds end = this->model.now() + longest;
    while (measuring.stage() != stage && this->model.now() < end) this->run(milliseconds(20));
    return measuring.stage() == stage;
  }
  void begin() {
    ASSERT_TRUE(reach(MeasuringStage::ready));
    this->model.leave();
    this->run(milliseconds(500));
    ASSERT_TRUE(measuring.begin({true, true, true}));
  }
  void finish() {
    for (int i = 0; i < 10'000 && measuring.stage() == MeasuringStage::pushing; ++i) {
      this->run(milliseconds(20));
      measuring.judge();
    }
  }
  void push() {
    for (int i = 0; i < 200 && this->motors_rest(); ++i) this->run(milliseconds(10));
    ASSERT_FALSE(this->motors_rest());
  }
  void expect_no_force_within(milliseconds time) {
    this->run(time);
    EXPECT_TRUE(this->motors_rest());
    const nanoseconds then = this->pulled_at;
    this->run(seconds(1));
    EXPECT_EQ(this->pulled_at, then) << "for good";
    EXPECT_FALSE(measuring.run()->result());
  }

  ForceStop stop;
  MeasuringServo measuring;
  bool servo_runs = true;
  std::function<void(nanoseconds)> before_step;

 private:
  nanoseconds next_ = milliseconds(1);
};

template <class Kind>
class MeasuredUsbTest : public ::testing::Test {};
using Kinds = ::testing::Types<Falcon, Polhem>;
TYPED_TEST_SUITE(MeasuredUsbTest, Kinds);

template <class Kind>
typename Kind::Options options_of(unsigned seed, double damping) {
  typename Kind::Options options;
  options.seed = seed;
  options.damping = damping;
  options.mass = seed % 2 == 0 ? 0.3 : 0.15;
  options.out_at = 0.05 * (seed * 7 % 20);
  if constexpr (requires { options.in_at; }) options.in_at = 0.05 * (seed * 3 % 20);
  return options;
}

// Number of failed readings in three seconds at a declared delay.
template <class Kind>
int failures(const typename Kind::Options& options, int delay) {
  Measured<Kind> device(options, delay);
  int failed = 0;
  device.servo_runs = false;
  bool counts = false;
  device.before_step = [&](nanoseconds now) {
    const bool ok = device.device.read(now).ok;
    if (counts && !ok) ++failed;
    device.device.write(Vector3d::Zero(), now);
  };
  device.run(seconds(6));
  counts = true;
  device.run(seconds(3));
  return failed;
}

// RECKON_SOAK=1 measures four.
TYPED_TEST(MeasuredUsbTest, FindsDampingAndDelayWithinTenPerCent) {
  const unsigned seeds = test::tries(1U, 4U);
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const double damping = seed <= 2 ? 0.4 : 2.0;
    const auto options = options_of<TypeParam>(seed, damping);
    Measured<TypeParam> device(options);
    device.begin();
    device.finish();
    ASSERT_EQ(device.measuring.stage(), MeasuringStage::ended);
    const DeviceMeasurement& run = *device.measuring.run();
    ASSERT_EQ(run.problem(), MeasurementProblem::none) << seed;
    std::printf("seed %u: b %.3f of %.3f N s/m (+- %.3f), delay %.2f ms of 6, %d is enough\n", seed,
                run.result()->damping, damping, run.result()->damping_error,
                1e3 * run.result()->delay, device.device.needed_delay());
    EXPECT_NEAR(run.result()->damping, damping, 0.1 * damping) << seed;
    EXPECT_NEAR(run.result()->mass, options.mass, 0.1 * options.mass) << seed;
    // By the ledger's contract a force counts after the declared number of writes.
    EXPECT_NEAR(1e3 * run.result()->delay, 6.0, 0.6) << seed;
  }
}

TYPED_TEST(MeasuredUsbTest, NeededDelaySufficesButNotOneLess) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto options = options_of<TypeParam>(seed, 1.0);
    int needed = 0;
    {
      Measured<TypeParam> device(options, 10);
      ASSERT_TRUE(device.reach(MeasuringStage::ready)) << seed;
      device.run(seconds(3));
      needed = device.device.needed_delay();
    }
    ASSERT_GT(needed, 1) << seed;
    EXPECT_EQ(failures<TypeParam>(options, needed), 0) << seed;
    EXPECT_GT(failures<TypeParam>(options, needed - 1), 0) << seed;
  }
}

TYPED_TEST(MeasuredUsbTest, MovesNothingBeforeTheStart) {
  Measured<TypeParam> device({});
  ASSERT_TRUE(device.reach(MeasuringStage::ready));
  device.run(seconds(1));
  EXPECT_EQ(device.pulled_at, nanoseconds(0)) << "no motor was ever asked";
  EXPECT_FALSE(device.measuring.judge());
}

TYPED_TEST(MeasuredUsbTest, RefusesAHeldHandle) {
  Measured<TypeParam> device({});
  ASSERT_TRUE(device.reach(MeasuringStage::ready));
  device.run(seconds(1));
  ASSERT_TRUE(device.measuring.begin({true, true, true}));
  device.finish();
  const MeasurementProblem problem = device.measuring.run()->problem();
  EXPECT_TRUE(problem == MeasurementProblem::unlike || problem == MeasurementProblem::stuck ||
              problem == MeasurementProblem::active)
      << static_cast<int>(problem);
  device.expect_no_force_within(milliseconds(10));
}

TYPED_TEST(MeasuredUsbTest, StopsADeviceThatGeneratesEnergy) {
  Measured<TypeParam> device({});
  device.begin();
  device.push();
  device.model.gain(-1.0);
  device.finish();
  const MeasurementProblem problem = device.measuring.run()->problem();
  EXPECT_TRUE(problem == MeasurementProblem::active || problem == MeasurementProblem::speed ||
              problem == MeasurementProblem::place || problem == MeasurementProblem::readings)
      << static_cast<int>(problem);
  device.expect_no_force_within(milliseconds(10));
}

TYPED_TEST(MeasuredUsbTest, UnplugEndsTheRunByFailedReadings) {
  Measured<TypeParam> device({});
  device.begin();
  device.push();
  device.shim.unplug();
  device.finish();
  EXPECT_EQ(device.measuring.run()->problem(), MeasurementProblem::readings);
  EXPECT_THAT(device.notices, Contains(HasSubstr("was unplugged")));
  // It comes back, and is not pushed again.
  device.shim.plug();
  device.expect_no_force_within(milliseconds(300));
}

TYPED_TEST(MeasuredUsbTest, LateServoEndsTheRunWithoutForce) {
  Measured<TypeParam> device({});
  device.begin();
  device.push();
  device.servo_runs = false;
  device.run(milliseconds(30));
  EXPECT_TRUE(device.motors_rest()) << "its own watchdog";
  device.servo_runs = true;
  device.run(milliseconds(3));
  EXPECT_EQ(device.measuring.stage(), MeasuringStage::ended);
  EXPECT_EQ(device.measuring.run()->problem(), MeasurementProblem::busy);
  device.expect_no_force_within(milliseconds(10));
}

TYPED_TEST(MeasuredUsbTest, UserOrSoftwareStopRemovesTheForce) {
  for (const bool by_stop : {false, true}) {
    Measured<TypeParam> device({});
    device.begin();
    device.push();
    by_stop ? device.stop.press(StopCause::signal) : device.measuring.halt();
    device.expect_no_force_within(milliseconds(10));
    EXPECT_EQ(device.measuring.stage(), by_stop ? MeasuringStage::stopped : MeasuringStage::halted);
    device.stop.release(StopCause::signal);
    device.expect_no_force_within(milliseconds(10));
    EXPECT_FALSE(device.measuring.begin({true, true, true})) << "it is not begun again";
  }
}

}  // namespace
}  // namespace reckon::haptics::measured_usb_test
