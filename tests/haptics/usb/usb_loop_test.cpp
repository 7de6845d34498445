// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Each kind of device behind the real libusb, the kernel's calls answered by a model: what fails,
// and what the servo, the user and the handle notice. All time is the model's.
#include "reckon/haptics/usb/usb_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Falcon {
  using Model = test::FalconModel;
  using Options = test::FalconModelOptions;
  static std::unique_ptr<UsbDriver> driver() {
    return std::make_unique<FalconDriver>(FalconFirmware{});
  }
  static const UsbFacts& facts() { return falcon_facts(); }
  static void wake(Model& model) { model.wake(); }
  static constexpr milliseconds kReady{1000};   // to be taken up
  static constexpr milliseconds kSettle{3000};  // to press again
};

struct Polhem {
  using Model = test::PolhemModel;
  using Options = test::PolhemModelOptions;
  static std::unique_ptr<UsbDriver> driver() { return std::make_unique<PolhemDriver>(); }
  static const UsbFacts& facts() { return polhem_facts(); }
  static void wake(Model&) {}
  static constexpr milliseconds kReady{3000};  // and homed
  static constexpr milliseconds kSettle{5000};
};

DeviceLimits limits(const UsbFacts& facts = falcon_facts()) {
  UsbSettings settings;
  settings.damping = 2.0;
  return usb_limits(facts, settings);
}

Vector3d pressing(double t) { return {0, 0, 0.02 - 0.04 * std::min(1.0, 2 * t)}; }

template <class Kind>
class Plugged : public test::PluggedDevice<typename Kind::Model> {
 public:
  explicit Plugged(std::function<Vector3d(double)> hand = pressing)
      : test::PluggedDevice<typename Kind::Model>(typename Kind::Options{}, std::move(hand),
                                                  Kind::driver(), limits(Kind::facts())) {}

  // Until the force is there.
  void press() {
    this->run(Kind::kSettle);
    ASSERT_GT(this->model.force().z(), 0.5) << "no wall is felt";
    this->notices.clear();
  }
};

template <class Kind>
class UsbLoopTest : public ::testing::Test {};
using Kinds = ::testing::Types<Falcon, Polhem>;
struct Names {
  template <class Kind>
  static std::string GetName(int) {
    return Kind::facts().name;
  }
};
TYPED_TEST_SUITE(UsbLoopTest, Kinds, Names);

TYPED_TEST(UsbLoopTest, UnpluggedTheForceIsZeroWithin10Ms) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.shim.unplug();
  usb.model.forget();  // the device itself has no power
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
  EXPECT_FALSE(usb.last.enabled);
  EXPECT_FALSE(usb.loop->stage());
  EXPECT_THAT(usb.notices, ::testing::ElementsAre(HasSubstr("unplugged")));
}

TYPED_TEST(UsbLoopTest, UnpluggedAtAnyInstantTheForceIsZeroWithin10Ms) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> instant(0, 400);
  // In and out: a hand that only holds still would not pay back what each ramp borrows.
  Plugged<TypeParam> usb([](double t) { return Vector3d(0, 0, 0.02 * std::sin(3 * t) - 0.01); });
  for (int i = 0; i < 60; ++i) {
    // Also while it is set up, and while the force ramps up.
    usb.run((i % 2 == 0 ? nanoseconds(TypeParam::kReady) : nanoseconds(0)) +
            std::chrono::microseconds(997) * instant(random));
    usb.shim.unplug();
    if (i % 3 == 0) usb.model.forget();
    usb.run(milliseconds(10));
    ASSERT_TRUE(usb.last.force.isZero(0)) << "round " << i;
    usb.run(milliseconds(10 + instant(random)));
    if (i % 3 == 0) TypeParam::wake(usb.model);
    usb.shim.plug();
  }
  double felt = 0;
  for (int i = 0; i < TypeParam::kSettle.count(); ++i) {
    usb.run(milliseconds(1));
    felt = std::max(felt, usb.model.force().z());
  }
  EXPECT_GT(felt, 0.5);
  EXPECT_GE(usb.least_books, -1e-9);
}

TYPED_TEST(UsbLoopTest, UnpluggedTheForceIsZeroWithin10MsHoweverLongTheChain) {
  DeviceLimits slow = limits(TypeParam::facts());
  slow.delay_samples = 30;
  test::PluggedDevice<typename TypeParam::Model> usb(typename TypeParam::Options{}, pressing,
                                                     TypeParam::driver(), slow);
  usb.run(TypeParam::kSettle);
  ASSERT_GT(usb.model.force().z(), 0.1);
  usb.shim.unplug();
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
}

TYPED_TEST(UsbLoopTest, PluggedInAgainItGoesOnByItselfAndTheForceRampsUp) {
  Plugged<TypeParam> usb;
  usb.press();
  const double before = usb.model.force().z();
  usb.shim.unplug();
  usb.run(milliseconds(700));
  usb.notices.clear();
  usb.shim.plug();
  double most_step = 0, last = usb.model.force().z();
  for (int i = 0; i < TypeParam::kSettle.count(); ++i) {
    usb.run(milliseconds(1));
    const double now = usb.model.force().z();
    most_step = std::max(most_step, std::abs(now - last));
    last = now;
  }
  EXPECT_THAT(usb.notices, Contains(HasSubstr("ready")));
  EXPECT_NEAR(last, before, 0.1);
  EXPECT_LT(most_step, 0.2) << "[N] in 1 ms";
  EXPECT_GE(usb.least_books, -1e-9);
}

TYPED_TEST(UsbLoopTest, ADeviceThatIsNotThereIsSaidOnceAndFoundLater) {
  Plugged<TypeParam> usb;
  usb.shim.unplug();
  usb.run(std::chrono::seconds(2));
  EXPECT_THAT(usb.notices, ::testing::ElementsAre(HasSubstr("none is attached")));
  EXPECT_TRUE(usb.last.force.isZero(0));
  usb.shim.plug();
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, AServoThatIsSilentLeavesNoForceAfter10Ms) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.servo_runs = false;
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.motors_rest());
  usb.run(std::chrono::seconds(1));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_THAT(usb.notices, IsEmpty());
  // It comes back: what the contacts hold is written off, and they fade in.
  usb.servo_runs = true;
  usb.run(milliseconds(50));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_GT(usb.last.trips, 0U);
  usb.run(std::chrono::seconds(2));
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, AtTheEndOfTheProgramTheDeviceIsToldAZero) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.loop.reset();
  usb.model.pass(std::chrono::microseconds(500));  // the octets are on the line
  EXPECT_TRUE(usb.motors_rest());
}

TYPED_TEST(UsbLoopTest, ATransferThatIsLateIsZeroWithin10Ms) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.model.hang(milliseconds(40));
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0)) << "the servo asks for none";
  usb.run(milliseconds(40));
  EXPECT_TRUE(usb.motors_rest());
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
  EXPECT_GE(usb.least_books, -1e-9);
}

TYPED_TEST(UsbLoopTest, AReportThatDoesNotComeIsAnsweredByAZero) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.model.mute(milliseconds(30));
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.motors_rest()) << "the device takes commands still";
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
  EXPECT_THAT(usb.notices, ::testing::Each(Not(HasSubstr("unplugged"))));
}

TYPED_TEST(UsbLoopTest, ADeviceThatGoesMuteIsSetUpAgain) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.model.mute(milliseconds(600));
  usb.run(milliseconds(400));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("does not answer any more")));
  EXPECT_TRUE(usb.motors_rest());
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, AStallIsSaidAndTheLineSetUpAgain) {
  Plugged<TypeParam> usb;
  usb.press();
  const nanoseconds fault = usb.model.now();
  usb.model.stall();
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_LE(usb.pulled_at - fault, milliseconds(10));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("refuses transfers")));
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, AShortTransferIsSaidAndTheLineSetUpAgain) {
  Plugged<TypeParam> usb;
  usb.press();
  const nanoseconds fault = usb.model.now();
  usb.model.cut();
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_LE(usb.pulled_at - fault, milliseconds(10));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("cut short")));
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TEST(UsbDevice, ReadsAndWritesAllocateNothing) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  const test::AllocationGuard guard;
  for (int i = 1; i <= 1000; ++i) {
    exchange.readings.push({Vector3d::Zero(), {}, i - 8, i - 7, 1, 0});
    static_cast<void>(device.read(milliseconds(i)));
    device.write(Vector3d::UnitX(), milliseconds(i));
  }
  EXPECT_EQ(guard.count(), 0U);
}

TEST(UsbDevice, AForceThatIsNoNumberIsNone) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  device.write(Vector3d(std::nan(""), 0, 0), milliseconds(1));
  exchange.force.update();
  EXPECT_TRUE(exchange.force.read().force.isZero(0));
}

// Each way of the handle is shown in the step for which the ledger books the force that was held.
TEST(UsbDevice, ShowsAReadingJustWhenItsForceIsDue) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
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

TEST(UsbDevice, AReadingThatIsLateFails) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 1, 1, 0});
  const int delay = device.limits().delay_samples;
  for (int write = 1; write <= 20; ++write) {
    EXPECT_EQ(device.read(milliseconds(write)).ok, write - 1 - delay < 1) << write;
    device.write(Vector3d::Zero(), milliseconds(write));
  }
}

// Else the first force after a silence would be that of a place from before it.
TEST(UsbDevice, AReadingFromBeforeASilenceOfTheServoIsNone) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_TRUE(device.read(milliseconds(1)).ok);
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_TRUE(device.read(milliseconds(11)).ok) << "its watchdog has not acted";
  device.write(Vector3d::UnitX(), milliseconds(11));
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 1, 0});
  EXPECT_FALSE(device.read(milliseconds(22)).ok);
  device.write(Vector3d::Zero(), milliseconds(22));
  EXPECT_FALSE(device.read(milliseconds(23)).ok) << "none has come since";
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 2, 0});
  const DeviceSample sample = device.read(milliseconds(24));
  EXPECT_TRUE(sample.ok && sample.watchdog);
}

// However long the chain may be that its user states.
TEST(UsbDevice, WhereARunIsOverNothingIsRead) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 3, 0});
  EXPECT_TRUE(device.read(milliseconds(1)).ok);
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.ended_run = 3;
  EXPECT_FALSE(device.read(milliseconds(2)).ok);
  exchange.readings.push({Vector3d::Zero(), {}, 0, 100, 4, 0});
  const DeviceSample sample = device.read(milliseconds(3));
  EXPECT_TRUE(sample.ok && sample.watchdog);
}

// Also over readings that failed, and not over a force that was dropped.
// Reports that are not due yet tell where the handle is by now.
TEST(UsbDevice, TellsTheDampingOfTheWorstPoseThatIsHereAndTheDriverWhatThatPaysFor) {
  UsbSettings settings;
  settings.joint_damping = 0.02;
  const UsbFacts& facts = falcon_facts();
  UsbExchange exchange;
  UsbDevice device(exchange, usb_limits(facts, settings));
  const DeviceLimits limits = device.limits();
  EXPECT_NEAR(limits.damping, facts.sure_share * 0.02 / (facts.lever * facts.lever), 1e-12);
  const auto push = [&](std::int64_t before, double lever) {
    UsbReading reading;
    reading.before = before;
    reading.after = before + 1;
    reading.run = 1;
    reading.lever = lever;
    reading.step = 1e-3 * lever;
    exchange.readings.push(reading);
  };
  push(0, 2 * facts.lever);
  push(1, 3 * facts.lever);
  DeviceSample sample = device.read(milliseconds(1));
  ASSERT_TRUE(sample.ok && sample.damping && sample.resolution);
  const double margin = std::sqrt(limits.damping / *sample.damping) / 3;
  EXPECT_GT(margin, 1.0) << "it goes on meanwhile";
  EXPECT_LT(margin, 1.2);
  EXPECT_EQ(*sample.resolution, 2e-3 * facts.lever) << "of the place that is shown";
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.force.update();
  EXPECT_NEAR(exchange.force.read().lever, 3 * margin * facts.lever, 1e-12);

  push(2, 0.1 * facts.lever);
  for (int i = 2; i < 20; ++i) {
    sample = device.read(milliseconds(i));
    device.write(Vector3d::UnitX(), milliseconds(i));
    if (!sample.ok) continue;
    EXPECT_LE(*sample.damping, limits.damping) << "no more than is stated";
  }
}

TEST(UsbDevice, OfADampingOfTheHandleItTellsNoneOfAPose) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  UsbReading reading;
  reading.after = reading.run = 1;
  reading.lever = 0.3;
  exchange.readings.push(reading);
  const DeviceSample sample = device.read(milliseconds(1));
  EXPECT_TRUE(sample.ok && !sample.damping && !sample.resolution);
  device.write(Vector3d::UnitX(), milliseconds(1));
  exchange.force.update();
  EXPECT_TRUE(std::isinf(exchange.force.read().lever));
}

TEST(UsbDevice, TellsTheLeastShareOfItsForceThatWasHeld) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  UsbReading reading;
  reading.after = reading.run = 1;
  for (const double held : {0.25, 1.0}) {
    reading.held = held;
    exchange.readings.push(reading);
  }
  EXPECT_EQ(device.read(milliseconds(1)).held, 0.25);
  exchange.readings.push(reading);
  EXPECT_EQ(device.read(milliseconds(1)).held, 1.0) << "told once";
}

TEST(UsbDevice, TellsHowLongAWayTookByTheDevicesOwnClock) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  const int delay = device.limits().delay_samples;
  const auto push = [&](std::int64_t before, std::int64_t after, std::uint32_t run,
                        nanoseconds at) {
    exchange.readings.push({Vector3d::Zero(), {}, before, after, run, 0, at});
  };
  push(0, 1, 1, milliseconds(100));
  push(1, 2, 1, milliseconds(103));
  push(4, 5, 1, milliseconds(107));  // 2 to 4 are not told
  push(5, 9, 1, milliseconds(108));
  std::vector<std::optional<nanoseconds>> took;
  for (int write = 1; write <= delay + 8; ++write) {
    if (write == delay + 8) push(0, 99, 2, milliseconds(200));
    const DeviceSample sample = device.read(milliseconds(write));
    device.write(Vector3d::Zero(), milliseconds(write));
    if (write > delay && sample.ok) took.push_back(sample.took);
  }
  using ::testing::ElementsAre;
  using ::testing::Optional;
  EXPECT_THAT(took, ElementsAre(Optional(nanoseconds(0)), Optional(milliseconds(3)),
                                Optional(milliseconds(4)), Optional(milliseconds(1)),
                                Optional(nanoseconds(0)), std::nullopt));
}

// The servo is late once; that way comes to it `delay` steps later, when it is punctual again.
TEST(UsbDevice, TellsHowLongAWayTookByTheWritesOfItsForceWhereItHasNoClock) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  const int delay = device.limits().delay_samples;
  nanoseconds now(0);
  for (int write = 1; write <= 3 * delay; ++write) {
    now += milliseconds(write == delay + 1 ? 4 : 1);
    exchange.readings.push({Vector3d::Zero(), {}, write - 1 - delay, write - delay, 1, 0});
    const DeviceSample sample = device.read(now);
    device.write(Vector3d::Zero(), now);
    if (write <= delay + 1) continue;
    ASSERT_TRUE(sample.ok) << write;
    const int due = write - 1 - delay;
    EXPECT_EQ(sample.took, milliseconds(due == delay ? 4 : 1)) << write;
  }
}

// 3 mm that a handle went while nobody read it: over a period it would be 16 mJ of damping.
TEST(UsbDevice, AWayBetweenTwoRunsCountsForNoDamping) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  ServoLoop servo(device, EffectPlan(Scene()), ServoConfig());
  nanoseconds now(0);
  const auto rest_at = [&](double x, std::uint32_t run) {
    for (int i = 0; i < 20; ++i) {
      now += milliseconds(1);
      exchange.readings.push({Vector3d(x, 0, 0), {}, 0, 1000, run, 0});
      servo.step(now);
    }
    servo.snapshots().update();
    return servo.snapshots().read();
  };
  EXPECT_EQ(rest_at(0, 1).port_energy, 0);
  const ServoSnapshot after = rest_at(0.003, 2);
  EXPECT_EQ(after.tally.let_go, 1U);
  EXPECT_NEAR(after.device.x(), 0.003, 1e-12);
  EXPECT_LE(after.port_energy, 1e-12);
}

// A hand that presses slowly, and of which nobody knows how it came out.
TEST(UsbDevice, WhereTheForceWasDroppedTheMeterLosesWhatTheWallStored) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
  ServoLoop servo(device, EffectPlan(test::stiff_floor()), ServoConfig());
  const int delay = device.limits().delay_samples;
  int write = 0;
  const auto read_at = [&](double z, std::uint32_t run) {
    const std::int64_t held = std::max(0, write++ - delay);
    exchange.readings.push({Vector3d(0, 0, z), {}, held, held + 1, run, 0});
    servo.step(milliseconds(write));
    servo.snapshots().update();
    return servo.snapshots().read();
  };
  for (int i = 0; i < 400; ++i) read_at(0.001 - 1e-5 * i, 1);
  const ServoSnapshot pressed = read_at(-0.003, 1);
  const double stored = 0.5 * pressed.force.z() * 0.003;
  ASSERT_GT(stored, 1e-4) << "no wall is felt";
  EXPECT_LE(read_at(0.001, 2).port_energy, pressed.port_energy - stored + 1e-12);
}

TEST(UsbDevice, TellsThatTheForceWasDropped) {
  UsbExchange exchange;
  UsbDevice device(exchange, limits());
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
