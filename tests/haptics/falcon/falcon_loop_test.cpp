// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon behind the real libusb; a model answers the kernel's calls: faults, and their effects on
// the servo, the user and the handle. All time is the model's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/falcon/falcon_kinematics.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"

namespace reckon::haptics::falcon_loop_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::FalconModel;
using test::FalconModelOptions;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

UsbSettings settings() {
  UsbSettings settings;
  settings.damping = 2.0;
  return settings;
}

Vector3d pressing(double t) { return {0, 0, 0.02 - 0.04 * std::min(1.0, 2 * t)}; }

class Plugged : public test::PluggedDevice<FalconModel> {
 public:
  explicit Plugged(const FalconModelOptions& options = {},
                   std::function<Vector3d(double)> hand = pressing, FalconFirmware firmware = {},
                   const UsbSettings& chosen = settings())
      : PluggedDevice(options, std::move(hand), std::make_unique<FalconDriver>(std::move(firmware)),
                      usb_limits(falcon_facts(), chosen)) {}

  // Until the force has arrived.
  void press() {
    run(std::chrono::seconds(3));
    ASSERT_GT(model.force().z(), 0.5) << "no wall is felt";
    notices.clear();
  }
};

TEST(FalconLoop, PositionsAndForcesHaveTheAxesSigns) {
  for (int axis = 0; axis < 3; ++axis) {
    Plugged falcon({}, [axis](double) { return Vector3d(0.02 * Vector3d::Unit(axis)); });
    falcon.servo_runs = false;
    DeviceSample sample;
    falcon.model.beside([&, next = nanoseconds(0)](nanoseconds now) mutable {
      if (now < next) return;
      next = now + milliseconds(1);
      sample = falcon.device.read(now);
      falcon.device.write(2.0 * Vector3d::Unit(axis), now);
    });
    falcon.run(milliseconds(300));
    ASSERT_TRUE(sample.ok);
    EXPECT_LT((sample.position - falcon.model.position()).norm(), 2e-4);
    EXPECT_LT((falcon.model.force() - 2.0 * Vector3d::Unit(axis)).norm(), 0.01);
    EXPECT_EQ(sample.buttons, 4U);
    EXPECT_EQ(falcon.model.latency(), 1);
  }
}

// The device's own ledger, for all phases of the chip's timer in the frame, hands and walls.
TEST(FalconLoop, NeverGivesUnpaidEnergy) {
  double least = 0, meter = -1, most_allowance = 0;
  std::uint64_t trips = 0, failed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    FalconModelOptions options;
    options.seed = seed;
    options.tick_at = 0.05 * seed - 0.025;
    options.mass = seed % 3 == 0 ? 0.5 : 0.1;
    options.hand_stiffness = 20 * seed;
    options.hand_damping = seed % 2 == 0 ? 0 : 2;  // the device itself must stop the handle
    const double wave = 2 * std::numbers::pi * (0.5 + 0.3 * seed);
    Plugged falcon(options, [=](double t) {
      const double turn = wave * std::min(t, 2.5);  // then it rests
      return Vector3d(0.01 * std::sin(0.7 * turn), 0.01 * std::cos(turn),
                      0.015 * std::sin(turn) - 0.01);
    });
    falcon.run(std::chrono::seconds(4));
    EXPECT_GE(falcon.least_books, -1e-9) << "seed " << seed;
    const double books = falcon.books();
    EXPECT_LE(falcon.last.port_energy, books + falcon.last.encoder_allowance) << "seed " << seed;
    least = std::min(least, falcon.least_own);
    meter = std::max(meter, falcon.last.port_energy - books);
    most_allowance = std::max(most_allowance, falcon.last.encoder_allowance);
    trips += falcon.last.trips;
    failed += falcon.last.tally.failed;
  }
  EXPECT_LE(trips, 20U) << "before there was a device";
  EXPECT_LE(failed, 200U);
  std::printf(
      "least %.3g J without any allowance, the meter above the books by %.3g J at most, "
      "allowance to %.3g J, %llu readings failed of 80,000\n",
      least, meter, most_allowance, static_cast<unsigned long long>(failed));
}

// If the chip's timer is in time for the next frame, an exchange takes 1 ms: half of the allowed
// time. It reports this, and a wall may be twice as stiff.
TEST(FalconLoop, DeclaredQuickChainAllowsStifferWalls) {
  const double standard = [] { return Plugged().servo.static_stiffness_limit(); }();
  UsbSettings quick = settings();
  quick.chain = std::chrono::microseconds(3500);
  Plugged falcon({}, pressing, {}, quick);
  EXPECT_GT(falcon.servo.static_stiffness_limit(), 1.4 * standard);
  falcon.run(std::chrono::seconds(3));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("an exchange takes 1.")));
  EXPECT_LE(falcon.last.tally.failed, 300U) << "during set-up";
  EXPECT_GT(falcon.model.force().z(), 0.5);
  EXPECT_GE(falcon.least_books, -1e-9);
}

// A delay declared too short: readings fail, forces are dropped, no energy is made.
TEST(FalconLoop, ChainSlowerThanDeclaredFailsReadings) {
  UsbSettings quick = settings();
  quick.chain = milliseconds(2);
  FalconModelOptions slow;
  slow.tick_at = 0.15;
  Plugged falcon(slow, pressing, {}, quick);
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.last.tally.failed, 500U);
  EXPECT_GE(falcon.least_books, -1e-9);
}

TEST(FalconLoop, SplitReportsAreReadAsWholeOnes) {
  Plugged falcon;
  falcon.model.split(true);
  falcon.run(std::chrono::seconds(3));
  // Pieces wait for the chip's timer repeatedly: an exchange may take longer than 2 ms.
  EXPECT_GE(falcon.least_books, -1e-9);
  EXPECT_TRUE(falcon.loop->stage());
  falcon.model.split(false);
  falcon.run(std::chrono::seconds(2));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, DamagedReportsGiveNoReading) {
  Plugged falcon;
  falcon.press();
  falcon.model.damage(200);
  falcon.run(milliseconds(300));
  EXPECT_GE(falcon.least_books, -1e-9);
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, WithoutHomingThereIsNoForce) {
  FalconModelOptions options;
  options.homed = false;
  Plugged falcon(options);
  falcon.run(std::chrono::seconds(1));
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("pull the handle out")));
  EXPECT_TRUE(falcon.motors_rest());
  falcon.model.home();
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, RefusesALatencyTimerThatCannotBeSet) {
  FalconModelOptions options;
  options.latency_set = 16;
  Plugged falcon(options);
  falcon.run(std::chrono::seconds(1));
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("reads 16 ms instead of 1 ms")));
  EXPECT_TRUE(falcon.motors_rest());
  EXPECT_FALSE(falcon.loop->stage());
}

std::vector<std::uint8_t> program() {
  std::vector<std::uint8_t> octets(5'000);
  for (std::size_t i = 0; i < octets.size(); ++i)
    octets[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  return octets;
}

TEST(FalconLoop, LoadsFirmwareFromTheNamedFile) {
  const std::string file = ::testing::TempDir() + "falcon_program.bin";
  const auto octets = program();
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(octets.data()),
             static_cast<std::streamsize>(octets.size()));
  FalconModelOptions options;
  options.has_firmware = false;
  options.firmware = octets;
  Plugged falcon(options, pressing, FalconFirmware::load(file));
  falcon.run(std::chrono::seconds(10));
  EXPECT_TRUE(falcon.model.has_firmware());
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("firmware loaded, 5000 octets")));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, WithoutFirmwareNamesItsSetting) {
  FalconModelOptions options;
  options.has_firmware = false;
  Plugged falcon(options);
  falcon.run(std::chrono::seconds(1));
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("firmware = \"FILE\"")));
}

TEST(FalconLoop, DifferentEchoStopsTheLoading) {
  FalconModelOptions options;
  options.has_firmware = false;
  options.firmware = program();
  Plugged falcon(options, pressing, {program()});
  falcon.model.damage(1);
  falcon.run(std::chrono::seconds(3));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("echo differs from the firmware")));
}

TEST(FalconLoop, RefusesAFileThatIsNoFirmware) {
  const std::string file = ::testing::TempDir() + "no_program.bin";
  std::ofstream(file) << "too short";
  for (const std::string& name : {file, std::string("/no/such/file")}) {
    try {
      static_cast<void>(FalconFirmware::load(name));
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  }
}

TEST(FalconDevice, ReportsTheDelayOfItsChain) {
  UsbSettings settings;
  settings.damping = 1.0;
  settings.max_force = 100;
  const DeviceLimits limits = usb_limits(falcon_facts(), settings);
  EXPECT_EQ(limits.delay_samples, 6);  // three exchanges of 2 ms
  EXPECT_EQ(limits.max_force, 8.9);
  EXPECT_EQ(limits.damping, 0.9);
  settings.period = std::chrono::microseconds(2500);
  EXPECT_EQ(usb_limits(falcon_facts(), settings).delay_samples, 3);
  settings.damping = -1;
  EXPECT_THROW(static_cast<void>(usb_limits(falcon_facts(), settings)), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics::falcon_loop_test
