// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Each kind of device behind the real libusb; a model answers the kernel's calls: faults, and their
// effects on the servo, the user and the handle. All time is the model's.
#include "reckon/haptics/usb/usb_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/usb_kinds.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::usb_loop_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Falcon : test::FalconKind {
  static void wake(Model& model) { model.wake(); }
  static constexpr milliseconds kReady{1000};   // until it is ready
  static constexpr milliseconds kSettle{3000};  // until it presses again
  static constexpr double kBeyond = 0.08;       // [m], out of reach
  static constexpr const char* kNotice = "ready: forces are active";
};

struct Polhem : test::PolhemKind {
  static void wake(Model&) {}
  static constexpr milliseconds kReady{3000};  // and homed
  static constexpr milliseconds kSettle{5000};
  static constexpr double kBeyond = 0.2;
  static constexpr const char* kNotice = "press its calibration button";
};

Vector3d pressing(double t) { return {0, 0, 0.02 - 0.04 * std::min(1.0, 2 * t)}; }

template <class Kind>
class Plugged : public test::PluggedDevice<typename Kind::Model> {
 public:
  explicit Plugged(std::function<Vector3d(double)> hand = pressing)
      : test::PluggedDevice<typename Kind::Model>(test::OptionsOf<typename Kind::Model>{},
                                                  std::move(hand), Kind::driver(),
                                                  test::damped_limits(Kind::facts())) {}

  // Until the force has arrived.
  void press() {
    this->run(Kind::kSettle);
    ASSERT_GT(this->model.force().z(), 0.5) << "no wall is felt";
    this->notices.clear();
  }
};

template <class Kind>
class UsbLoopTest : public ::testing::Test {};
using Kinds = ::testing::Types<Falcon, Polhem>;
TYPED_TEST_SUITE(UsbLoopTest, Kinds, test::UsbKindNames);

TYPED_TEST(UsbLoopTest, WallIsFeltThroughTheRealLibrary) {
  Plugged<TypeParam> usb;
  usb.run(TypeParam::kSettle);
  EXPECT_THAT(usb.notices, Contains(HasSubstr(TypeParam::kNotice)));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("ready: forces are active")));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("an exchange takes 1.")));
  // A wall spring K against the hand's of 200 N/m, 20 mm behind it.
  const double wall = usb.servo.static_stiffness_limit();
  const double force = 200 * wall / (200 + wall) * 0.02;
  EXPECT_NEAR(usb.model.force().z(), force, 0.05);
  EXPECT_NEAR(usb.last.force.z(), force, 0.05);
  EXPECT_LT((usb.last.device - usb.model.position()).norm(), 1e-4);
  EXPECT_LE(usb.last.trips, 1U) << "before there was a device";
}

TYPED_TEST(UsbLoopTest, NoForceAtTheEndOfItsReach) {
  double out = 0;
  Plugged<TypeParam> usb([&](double t) { return Vector3d(pressing(t) - Vector3d(0, out, 0)); });
  usb.press();
  out = TypeParam::kBeyond;
  usb.run(milliseconds(1000));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("end of its range")));
  EXPECT_TRUE(usb.motors_rest());
  out = 0;
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, UnplugZeroesTheForceWithin10Ms) {
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

TYPED_TEST(UsbLoopTest, UnplugAtAnyInstantZeroesTheForce) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> instant(0, 400);
  // In and out: a hand at rest would not pay back the loan of each ramp.
  Plugged<TypeParam> usb([](double t) { return Vector3d(0, 0, 0.02 * std::sin(3 * t) - 0.01); });
  for (int i = 0; i < test::tries(18, 60); ++i) {
    // Also during set-up, and while the force ramps up.
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

TYPED_TEST(UsbLoopTest, UnplugWithALongChainZeroesTheForce) {
  DeviceLimits slow = test::damped_limits(TypeParam::facts());
  slow.delay_samples = 30;
  test::PluggedDevice<typename TypeParam::Model> usb(test::OptionsOf<typename TypeParam::Model>{},
                                                     pressing, TypeParam::driver(), slow);
  usb.run(TypeParam::kSettle);
  ASSERT_GT(usb.model.force().z(), 0.1);
  usb.shim.unplug();
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
}

TYPED_TEST(UsbLoopTest, PluggedInAgainTheForceRampsUp) {
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

TYPED_TEST(UsbLoopTest, MissingDeviceIsReportedOnceAndFoundLater) {
  Plugged<TypeParam> usb;
  usb.shim.unplug();
  usb.run(std::chrono::seconds(2));
  EXPECT_THAT(usb.notices, ::testing::ElementsAre(HasSubstr("none is attached")));
  EXPECT_TRUE(usb.last.force.isZero(0));
  usb.shim.plug();
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, SilentServoLeavesNoForceAfter10Ms) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.servo_runs = false;
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.motors_rest());
  usb.run(std::chrono::seconds(1));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_THAT(usb.notices, IsEmpty());
  // It comes back: the energy of the contacts is written off, and they fade in.
  usb.servo_runs = true;
  usb.run(milliseconds(50));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_GT(usb.last.trips, 0U);
  usb.run(std::chrono::seconds(2));
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, EndOfTheProgramSendsAZero) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.loop.reset();
  usb.model.pass(std::chrono::microseconds(500));  // the octets are on the line
  EXPECT_TRUE(usb.motors_rest());
}

TYPED_TEST(UsbLoopTest, LateTransferZeroesTheForceWithin10Ms) {
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

TYPED_TEST(UsbLoopTest, MissingReportIsAnsweredByAZero) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.model.mute(milliseconds(30));
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.motors_rest()) << "the device takes commands still";
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
  EXPECT_THAT(usb.notices, ::testing::Each(Not(HasSubstr("unplugged"))));
}

TYPED_TEST(UsbLoopTest, MuteDeviceIsSetUpAgain) {
  Plugged<TypeParam> usb;
  usb.press();
  usb.model.mute(milliseconds(600));
  usb.run(milliseconds(400));
  EXPECT_THAT(usb.notices, Contains(HasSubstr("stopped answering")));
  EXPECT_TRUE(usb.motors_rest());
  usb.run(TypeParam::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

// A fault that breaks the line while the device stays.
template <class Kind>
void break_line(void (*strike)(typename Kind::Model&), const char* notice) {
  Plugged<Kind> usb;
  usb.press();
  const nanoseconds fault = usb.model.now();
  strike(usb.model);
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
  EXPECT_TRUE(usb.motors_rest());
  EXPECT_LE(usb.pulled_at - fault, milliseconds(10));
  EXPECT_THAT(usb.notices, Contains(HasSubstr(notice)));
  usb.run(Kind::kSettle);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

TYPED_TEST(UsbLoopTest, StallIsReportedAndTheLineSetUp) {
  break_line<TypeParam>([](auto& model) { model.stall(); }, "refuses transfers");
}

TYPED_TEST(UsbLoopTest, ShortTransferIsReportedAndLineSetUp) {
  break_line<TypeParam>([](auto& model) { model.cut(); }, "cut short");
}

}  // namespace
}  // namespace reckon::haptics::usb_loop_test
