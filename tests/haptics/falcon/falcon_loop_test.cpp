// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Falcon behind the real libusb, the kernel's calls answered by a model: what fails, and what the
// servo, the user and the handle notice. All time is the model's.
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
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::FalconModel;
using test::FalconModelOptions;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kWallAt = 0.0;  // [m], from above along z

Scene wall() {
  Scene scene;
  SceneObject object;
  object.effects.of<SpringDamper>().stiffness = 20'000;  // softened to what the device can hold
  object.name = "wall";
  object.shape = PlaneShape{Vector3d::UnitZ()};
  scene.objects.push_back(object);
  return scene;
}

UsbSettings settings() {
  UsbSettings settings;
  settings.damping = 2.0;
  return settings;
}

ServoConfig servo_config() {
  ServoConfig config;
  config.probe_radius = 0;
  return config;
}

Vector3d pressing(double t) { return {0, 0, 0.02 - 0.04 * std::min(1.0, 2 * t)}; }

// Model, thread and servo on one clock. The servo steps every millisecond, beside the thread.
class Plugged {
 public:
  explicit Plugged(const FalconModelOptions& options = {},
                   std::function<Vector3d(double)> hand = pressing, FalconFirmware firmware = {},
                   const UsbSettings& chosen = settings())
      : model(options, std::move(hand)),
        shim(model),
        device(exchange, usb_limits(falcon_facts(), chosen)),
        servo(device, EffectPlan(wall()), servo_config()),
        loop(std::make_unique<UsbLoop>(
            exchange, std::make_unique<FalconDriver>(std::move(firmware)), loop_options())) {
    model.beside([this](nanoseconds now) {
      if (now < next_step_) return;
      next_step_ += period_;
      if (servo_runs) step_servo(now);
    });
  }

  void run(nanoseconds time) {
    const nanoseconds end = model.now() + time;
    while (model.now() < end) {
      loop->step(milliseconds(1));
      for (std::string& notice : loop->take_notices()) notices.push_back(std::move(notice));
    }
  }

  // Until the force is there.
  void press() {
    run(std::chrono::seconds(3));
    ASSERT_GT(model.force().z(), 0.5) << "no wall is felt";
    notices.clear();
  }

  [[nodiscard]] bool motors_rest() const { return model.motors() == std::array<std::int16_t, 3>{}; }

  FalconModel model;
  test::UsbShim shim;
  UsbExchange exchange;
  UsbDevice device;
  ServoLoop servo;
  std::unique_ptr<UsbLoop> loop;
  std::vector<std::string> notices;
  bool servo_runs = true;
  double least_own = 0;    // [J], of the device's own books with loan
  double least_books = 0;  // [J], of the device's own books with loan and allowance
  ServoSnapshot last;

 private:
  UsbLoopOptions loop_options() {
    UsbLoopOptions options;
    options.clock = [this] { return model.now(); };
    options.open = [this](libusb_context* context) {
      UsbOpening opening{shim.open(context), {}};
      if (opening.handle == nullptr) opening.problem = "none is attached";
      return opening;
    };
    options.discover = false;
    return options;
  }

  void step_servo(nanoseconds now) {
    servo.step(now);
    servo.snapshots().update();
    last = servo.snapshots().read();
    const double books = model.port_work() + model.damping_loss();
    least_own = std::min(least_own, books + last.loan);
    least_books = std::min(least_books, books + last.loan + last.encoder_allowance);
  }

  nanoseconds period_ = milliseconds(1);
  nanoseconds next_step_ = milliseconds(1);
};

TEST(FalconLoop, AWallIsFeltThroughTheRealLibrary) {
  Plugged falcon;
  falcon.run(std::chrono::seconds(3));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("ready: forces are shown")));
  EXPECT_EQ(falcon.model.latency(), 1);
  // A spring K of the wall against the hand's of 200 N/m, 20 mm behind it.
  const double wall = falcon.servo.static_stiffness_limit();
  const double force = 200 * wall / (200 + wall) * 0.02;
  EXPECT_NEAR(falcon.model.force().z(), force, 0.05);
  EXPECT_NEAR(falcon.last.force.z(), force, 0.05);
  EXPECT_NEAR(falcon.last.device.z(), falcon.model.position().z(), 1e-4);
  EXPECT_LE(falcon.last.trips, 1U) << "before there was a device";
}

TEST(FalconLoop, PositionsAndForcesHaveTheSignsOfTheAxes) {
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
  }
}

// The device's own books, over where the chip's timer stands in the frame, hands and walls.
TEST(FalconLoop, NeverGivesMoreEnergyThanTheHandPutIn) {
  double least = 0, meter = -1, most_allowance = 0;
  std::uint64_t trips = 0, failed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    FalconModelOptions options;
    options.seed = seed;
    options.tick_at = 0.05 * seed - 0.025;
    options.mass = seed % 3 == 0 ? 0.5 : 0.1;
    options.hand_stiffness = 20 * seed;
    options.hand_damping = seed % 2 == 0 ? 0 : 2;  // most of what stops the handle is the device's
    const double wave = 2 * std::numbers::pi * (0.5 + 0.3 * seed);
    Plugged falcon(options, [=](double t) {
      const double turn = wave * std::min(t, 2.5);  // then it holds still
      return Vector3d(0.01 * std::sin(0.7 * turn), 0.01 * std::cos(turn),
                      0.015 * std::sin(turn) - 0.01);
    });
    falcon.run(std::chrono::seconds(4));
    EXPECT_GE(falcon.least_books, -1e-9) << "seed " << seed;
    const double books = falcon.model.port_work() + falcon.model.damping_loss();
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

// Where the chip's timer is in time for the next frame, an exchange takes 1 ms: half of what is
// allowed for. It says so, and a wall may be twice as stiff.
TEST(FalconLoop, AQuickChainMayBeStatedAndAllowsStifferWalls) {
  const double standard = [] { return Plugged().servo.static_stiffness_limit(); }();
  UsbSettings quick = settings();
  quick.chain = std::chrono::microseconds(3500);
  Plugged falcon({}, pressing, {}, quick);
  EXPECT_GT(falcon.servo.static_stiffness_limit(), 1.4 * standard);
  falcon.run(std::chrono::seconds(3));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("an exchange takes 1.")));
  EXPECT_LE(falcon.last.tally.failed, 300U) << "while it was set up";
  EXPECT_GT(falcon.model.force().z(), 0.5);
  EXPECT_GE(falcon.least_books, -1e-9);
}

// One that is too short is not believed: readings fail, forces stay away, no energy is made.
TEST(FalconLoop, AChainThatIsSlowerThanStatedGivesFailedReadingsAndNoEnergy) {
  UsbSettings quick = settings();
  quick.chain = milliseconds(2);
  FalconModelOptions slow;
  slow.tick_at = 0.15;
  Plugged falcon(slow, pressing, {}, quick);
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.last.tally.failed, 500U);
  EXPECT_GE(falcon.least_books, -1e-9);
}

TEST(FalconLoop, UnpluggedTheForceIsZeroWithin10Ms) {
  Plugged falcon;
  falcon.press();
  falcon.shim.unplug();
  falcon.model.forget();  // the device itself has no power
  falcon.run(milliseconds(10));
  EXPECT_TRUE(falcon.last.force.isZero(0));
  EXPECT_FALSE(falcon.last.enabled);
  EXPECT_FALSE(falcon.loop->stage());
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("unplugged")));
}

TEST(FalconLoop, UnpluggedAtAnyInstantTheForceIsZeroWithin10Ms) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> instant(0, 400);
  // In and out: a hand that only holds still would not pay back what each ramp borrows.
  Plugged falcon({}, [](double t) { return Vector3d(0, 0, 0.02 * std::sin(3 * t) - 0.01); });
  for (int i = 0; i < 60; ++i) {
    // Also while it is set up, and while the force ramps up.
    falcon.run(milliseconds(i % 2 == 0 ? 1000 : 0) +
               std::chrono::microseconds(997) * instant(random));
    falcon.shim.unplug();
    if (i % 3 == 0) falcon.model.forget();
    falcon.run(milliseconds(10));
    ASSERT_TRUE(falcon.last.force.isZero(0)) << "round " << i;
    falcon.run(milliseconds(10 + instant(random)));
    if (i % 3 == 0) falcon.model.wake();
    falcon.shim.plug();
  }
  double felt = 0;
  for (int i = 0; i < 3000; ++i) {
    falcon.run(milliseconds(1));
    felt = std::max(felt, falcon.model.force().z());
  }
  EXPECT_GT(felt, 0.5);
  EXPECT_GE(falcon.least_books, -1e-9);
}

TEST(FalconLoop, PluggedInAgainItGoesOnByItselfAndTheForceRampsUp) {
  Plugged falcon;
  falcon.press();
  const double before = falcon.model.force().z();
  falcon.shim.unplug();
  falcon.run(milliseconds(700));
  falcon.notices.clear();
  falcon.shim.plug();
  double most_step = 0, last = falcon.model.force().z();
  for (int i = 0; i < 3000; ++i) {
    falcon.run(milliseconds(1));
    const double now = falcon.model.force().z();
    most_step = std::max(most_step, std::abs(now - last));
    last = now;
  }
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("ready")));
  EXPECT_NEAR(last, before, 0.1);
  EXPECT_LT(most_step, 0.2) << "[N] in 1 ms";
  EXPECT_GE(falcon.least_books, -1e-9);
}

TEST(FalconLoop, AFalconThatIsNotThereIsSaidOnceAndFoundLater) {
  Plugged falcon;
  falcon.shim.unplug();
  falcon.run(std::chrono::seconds(2));
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("none is attached")));
  EXPECT_TRUE(falcon.last.force.isZero(0));
  falcon.shim.plug();
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, AServoThatIsSilentLeavesNoForceAfter10Ms) {
  Plugged falcon;
  falcon.press();
  falcon.servo_runs = false;
  falcon.run(milliseconds(10));
  EXPECT_TRUE(falcon.motors_rest());
  falcon.run(std::chrono::seconds(1));
  EXPECT_TRUE(falcon.motors_rest());
  EXPECT_THAT(falcon.notices, IsEmpty());
  // It comes back: what the contacts hold is written off, and they fade in.
  falcon.servo_runs = true;
  falcon.run(milliseconds(50));
  EXPECT_TRUE(falcon.motors_rest());
  EXPECT_GT(falcon.last.trips, 0U);
  falcon.run(std::chrono::seconds(2));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, AtTheEndOfTheProgramTheDeviceIsToldAZero) {
  Plugged falcon;
  falcon.press();
  falcon.loop.reset();
  falcon.model.pass(std::chrono::microseconds(500));  // the octets are on the line
  EXPECT_TRUE(falcon.motors_rest());
}

TEST(FalconLoop, ATransferThatIsLateIsZeroWithin10Ms) {
  Plugged falcon;
  falcon.press();
  falcon.model.hang(milliseconds(40));
  falcon.run(milliseconds(10));
  EXPECT_TRUE(falcon.last.force.isZero(0)) << "the servo asks for none";
  falcon.run(milliseconds(40));
  EXPECT_TRUE(falcon.motors_rest());
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
  EXPECT_GE(falcon.least_books, -1e-9);
}

TEST(FalconLoop, AReportThatDoesNotComeIsAnsweredByAZero) {
  Plugged falcon;
  falcon.press();
  falcon.model.mute(milliseconds(30));
  falcon.run(milliseconds(10));
  EXPECT_TRUE(falcon.motors_rest()) << "the device takes commands still";
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
  EXPECT_THAT(falcon.notices, ::testing::Each(Not(HasSubstr("unplugged"))));
}

TEST(FalconLoop, ADeviceThatGoesMuteIsSetUpAgain) {
  Plugged falcon;
  falcon.press();
  falcon.model.mute(milliseconds(600));
  falcon.run(milliseconds(400));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("does not answer any more")));
  EXPECT_TRUE(falcon.motors_rest());
  falcon.run(std::chrono::seconds(4));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, AStallIsSaidAndTheLineSetUpAgain) {
  Plugged falcon;
  falcon.press();
  falcon.model.stall();
  falcon.run(milliseconds(10));
  EXPECT_TRUE(falcon.last.force.isZero(0));
  EXPECT_TRUE(falcon.motors_rest());
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("refuses transfers")));
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, AShortTransferIsSaidAndTheLineSetUpAgain) {
  Plugged falcon;
  falcon.press();
  falcon.model.cut();
  falcon.run(milliseconds(10));
  EXPECT_TRUE(falcon.last.force.isZero(0));
  EXPECT_TRUE(falcon.motors_rest());
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("cut short")));
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, ReportsInPiecesAreFeltAsWholeOnes) {
  Plugged falcon;
  falcon.model.split(true);
  falcon.run(std::chrono::seconds(3));
  // Pieces take the chip's timer again and again: an exchange may be longer than 2 ms.
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

TEST(FalconLoop, WithoutHomingThereIsNoForceAndTheUserIsToldWhatToDo) {
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

TEST(FalconLoop, AtTheEndOfItsReachThereIsNoForce) {
  double out = 0;
  Plugged falcon({}, [&](double t) { return Vector3d(pressing(t) - Vector3d(0, out, 0)); });
  falcon.press();
  out = 0.08;
  falcon.run(std::chrono::seconds(1));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("end of its reach")));
  EXPECT_TRUE(falcon.motors_rest());
  out = 0;
  falcon.run(std::chrono::seconds(3));
  EXPECT_GT(falcon.model.force().z(), 0.5);
}

TEST(FalconLoop, ALatencyTimerThatCannotBeSetIsRefused) {
  FalconModelOptions options;
  options.latency_set = 16;
  Plugged falcon(options);
  falcon.run(std::chrono::seconds(1));
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("reads 16 ms where 1 ms was set")));
  EXPECT_TRUE(falcon.motors_rest());
  EXPECT_FALSE(falcon.loop->stage());
}

std::vector<std::uint8_t> program() {
  std::vector<std::uint8_t> octets(5'000);
  for (std::size_t i = 0; i < octets.size(); ++i)
    octets[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  return octets;
}

TEST(FalconLoop, FirmwareIsLoadedFromTheFileThatTheUserNames) {
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

TEST(FalconLoop, WithoutFirmwareItSaysWhereToNameOne) {
  FalconModelOptions options;
  options.has_firmware = false;
  Plugged falcon(options);
  falcon.run(std::chrono::seconds(1));
  EXPECT_THAT(falcon.notices, ::testing::ElementsAre(HasSubstr("firmware = \"FILE\"")));
}

TEST(FalconLoop, AnEchoThatDiffersStopsTheLoading) {
  FalconModelOptions options;
  options.has_firmware = false;
  options.firmware = program();
  Plugged falcon(options, pressing, {program()});
  falcon.model.damage(1);
  falcon.run(std::chrono::seconds(3));
  EXPECT_THAT(falcon.notices, Contains(HasSubstr("echoes is not the firmware")));
}

TEST(FalconLoop, AFileThatIsNoFirmwareIsRefusedWithItsName) {
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

TEST(FalconDevice, TellsWhatItsChainIs) {
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

TEST(FalconDevice, ReadsAndWritesAllocateNothing) {
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(falcon_facts(), settings()));
  const test::AllocationGuard guard;
  for (int i = 1; i <= 1000; ++i) {
    exchange.readings.push({Vector3d::Zero(), {}, i - 8, i - 7, 1, 0});
    static_cast<void>(device.read(milliseconds(i)));
    device.write(Vector3d::UnitX(), milliseconds(i));
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(FalconDevice, AForceThatIsNoNumberIsNone) {
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(falcon_facts(), settings()));
  device.write(Vector3d(std::nan(""), 0, 0), milliseconds(1));
  exchange.force.update();
  EXPECT_TRUE(exchange.force.read().force.isZero(0));
}

// Each way of the handle is shown in the step for which the ledger books the force that was held.
TEST(FalconDevice, ShowsAReadingJustWhenItsForceIsDue) {
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(falcon_facts(), settings()));
  const int delay = device.limits().delay_samples;
  // The force of write 10 is held until the place 0.1, and that of write 12 (11 was left out) from
  // then on until 0.2.
  exchange.readings.push({Vector3d::Zero(), {}, 0, 10, 1, 0});
  exchange.readings.push({Vector3d(0.1, 0, 0), {}, 10, 12, 1, 0});
  exchange.readings.push({Vector3d(0.2, 0, 0), {}, 12, 40, 1, 0});
  for (int write = 1; write <= 12 + delay + 1; ++write) {
    const DeviceSample sample = device.read(milliseconds(write));
    device.write(Vector3d::Zero(), milliseconds(write));
    ASSERT_TRUE(sample.ok);
    const int due = write - 1 - delay;  // the write whose sample ends here
    EXPECT_EQ(sample.position.x(), due < 10 ? 0.0 : due < 12 ? 0.1 : 0.2) << due;
    EXPECT_FALSE(sample.watchdog);
  }
}

TEST(FalconDevice, AReadingThatIsLateFails) {
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(falcon_facts(), settings()));
  exchange.readings.push({Vector3d::Zero(), {}, 0, 1, 1, 0});
  const int delay = device.limits().delay_samples;
  for (int write = 1; write <= 20; ++write) {
    EXPECT_EQ(device.read(milliseconds(write)).ok, write - 1 - delay < 1) << write;
    device.write(Vector3d::Zero(), milliseconds(write));
  }
}

TEST(FalconDevice, TellsThatTheForceWasDropped) {
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(falcon_facts(), settings()));
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_TRUE(device.read(milliseconds(1)).ok);
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 2, 0});
  const DeviceSample sample = device.read(milliseconds(2));
  EXPECT_TRUE(sample.ok && sample.watchdog);
  EXPECT_FALSE(sample.released_at) << "nobody knows where";
  EXPECT_FALSE(device.read(milliseconds(3)).watchdog);
}

}  // namespace
}  // namespace reckon::haptics
