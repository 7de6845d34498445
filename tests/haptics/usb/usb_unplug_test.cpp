// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A pulled plug or an ending program during another action. `./run fuzz unplugs` does it at random.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/usb_kinds.hpp"

namespace reckon::haptics::usb_unplug_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;

Vector3d pressing(double t) { return {0, 0, 0.02 - 0.04 * std::min(1.0, 2 * t)}; }

template <class Kind>
class Plugged : public test::PluggedDevice<typename Kind::Model> {
 public:
  explicit Plugged(const test::OptionsOf<typename Kind::Model>& options = {})
      : test::PluggedDevice<typename Kind::Model>(options, pressing, Kind::driver(),
                                                  test::damped_limits(Kind::facts())) {}
};
using PluggedFalcon = Plugged<test::FalconKind>;
using PluggedPolhem = Plugged<test::PolhemKind>;

// For each failing call to the kernel.
template <class Kind>
void unplug_at_each_call() {
  constexpr unsigned kCalls = 60;  // includes some of the first exchanges
  for (unsigned call = 0; call < kCalls; ++call) {
    const auto usb = std::make_unique<Plugged<Kind>>();
    unsigned calls = 0;
    usb->shim.at_each_call([&] {
      if (calls++ == call) usb->shim.unplug();
    });
    for (int i = 0; i < 500 && usb->shim.is_plugged(); ++i) usb->run(milliseconds(1));
    usb->run(milliseconds(10));
    EXPECT_FALSE(usb->loop->stage()) << "call " << call;
    usb->run(milliseconds(400));
    EXPECT_THAT(usb->notices, Each(AnyOf(HasSubstr("was unplugged"), HasSubstr("none is attached"),
                                         HasSubstr("ready"), HasSubstr("not homed"))))
        << "call " << call;
    EXPECT_LE(usb->notices.size(), 3U);
    EXPECT_EQ(usb->shim.outstanding(), 0U);
    usb->notices.clear();
    usb->shim.plug();
    for (int i = 0; i < 500 && !usb->loop->stage(); ++i) usb->run(milliseconds(1));
    EXPECT_TRUE(usb->loop->stage()) << "call " << call;
  }
}

TEST(UsbUnplug, AtEachSetUpCallIsRecovered) {
  unplug_at_each_call<test::FalconKind>();
  unplug_at_each_call<test::PolhemKind>();
}

TEST(UsbUnplug, QuickReplugDropsTheOldLine) {
  PluggedFalcon usb;
  usb.run(milliseconds(3'000));
  ASSERT_GT(usb.model.force().z(), 0.5);
  usb.notices.clear();
  usb.shim.unplug();
  usb.model.forget_line();
  usb.shim.plug();
  const std::uint64_t commands = usb.model.commands();
  usb.run(milliseconds(10));
  EXPECT_THAT(usb.notices, ::testing::ElementsAre(HasSubstr("was unplugged")));
  EXPECT_TRUE(usb.last.force.isZero(0));
  EXPECT_EQ(usb.model.commands(), commands) << "nothing is told to what was not set up";
  usb.run(milliseconds(3'000));
  EXPECT_GT(usb.model.force().z(), 0.5);
}

// An FTDI chip then has another speed.
TEST(UsbUnplug, PortResetSetsItUpAgain) {
  PluggedFalcon usb;
  usb.run(milliseconds(3'000));
  usb.notices.clear();
  usb.shim.reset_port();
  usb.model.forget_line();
  usb.run(milliseconds(10));
  EXPECT_TRUE(usb.last.force.isZero(0));
  usb.run(milliseconds(3'000));
  EXPECT_GT(usb.model.force().z(), 0.5);
}

// It obeys after its report was fetched, and the line is closed soon after.
TEST(UsbUnplug, LastZeroIsObeyedAtAnyPhase) {
  for (int phase = 0; phase < 20; ++phase) {
    test::PolhemModelOptions options;
    options.out_at = 0.05 * phase;
    options.in_at = 0.95;
    PluggedPolhem usb(options);
    usb.run(milliseconds(3'000) + phase * std::chrono::microseconds(50));
    ASSERT_FALSE(usb.motors_rest());
    usb.loop.reset();
    usb.model.pass(milliseconds(1));
    EXPECT_TRUE(usb.motors_rest()) << phase;
  }
}

// The numbers of runs continue.
TEST(UsbUnplug, SecondThreadOnTheSameExchangeIsRead) {
  PluggedFalcon usb;
  for (int i = 0; i < 3; ++i) {
    usb.run(milliseconds(1'000));
    ASSERT_TRUE(usb.last.enabled);
    usb.shim.unplug();
    usb.run(milliseconds(10));
    usb.shim.plug();
  }
  usb.begin_thread(std::make_unique<FalconDriver>(FalconFirmware{}));
  usb.run(milliseconds(3'000));
  EXPECT_TRUE(usb.last.enabled);
  EXPECT_GT(usb.model.force().z(), 0.5);
}

}  // namespace
}  // namespace reckon::haptics::usb_unplug_test
