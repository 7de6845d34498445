// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A wheel or stick that the kernel does not drive, with its thread and its servo: the forces at the
// hand, faults, and the wheel's own ledger. All time is the wheel's; a report takes some of it.
#include "reckon/haptics/hid/hid_events.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/hid_wheel.hpp"
#include "reckon/tests/haptics/support/plugged_events.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::hid_events_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using test::HidWheel;
using test::HidWheelOptions;
using test::settings_for;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Hand = test::PluggedEvents<HidWheel>::Hand;

// Pushes into two walls and stays 10 mm behind each, after their set-up.
HidWheel::Places pressing(double t) {
  const double share = std::clamp(2 * t - 1, 0.0, 1.0);
  return {-0.03 * share, 0.03 * share};
}

class Plugged : public test::PluggedEvents<HidWheel> {
 public:
  explicit Plugged(const HidWheelOptions& options = {}, Hand hand = pressing)
      : PluggedEvents(options, std::move(hand), test::four_walls(), settings_for(options),
                      microseconds(100)) {}
};

TEST(HidEvents, WallsAreFeltAlongBothAxes) {
  Plugged plugged;
  plugged.run(milliseconds(300));
  static_cast<void>(plugged.steps_without());
  plugged.run(milliseconds(3000));
  EXPECT_THAT(plugged.notices, ElementsAre(HasSubstr("Reckon FFBoard model: ready")));
  for (const std::size_t axis : {0U, 1U}) {
    const double depth = std::abs(plugged.model.wheel.place(axis)) - 0.02;
    EXPECT_NEAR(depth, 0.01 * 300 / 1300, 1e-4);
    const double sign = axis == 0 ? 1 : -1;
    // One step of the device's position (12.5 um) and coefficient (0.2 N/m), and of the event
    // device's numbers.
    const double within = 1'000 * 17e-6 + 0.3 * depth;
    EXPECT_NEAR(plugged.model.wheel.force(axis), sign * 1'000 * depth, within);
    EXPECT_NEAR(plugged.last().force[static_cast<Eigen::Index>(axis)],
                plugged.model.wheel.force(axis), within);
  }
  EXPECT_EQ(plugged.model.wheel.strange(), 0);
  EXPECT_EQ(plugged.steps_without(), 0) << "its own reports keep the readings from ageing";
}

TEST(HidEvents, WheelOfOneAxisFeelsWallsAlongIt) {
  HidWheelOptions options;
  options.wheel.axes = 1;
  Plugged plugged(options);
  plugged.run(milliseconds(2000));
  EXPECT_NEAR(plugged.model.wheel.place(0), -0.02 - 0.01 * 300 / 1300, 1e-4);
}

TEST(HidEvents, RestingWallsAreUploadedOnce) {
  const Hand rests = [](double) { return HidWheel::Places{0, 0}; };
  Plugged plugged({}, rests);
  plugged.run(milliseconds(1000));
  const int before = plugged.model.wheel.changes();
  plugged.run(milliseconds(1000));
  EXPECT_EQ(plugged.model.wheel.changes(), before);
}

TEST(HidEvents, LeavesKernelDrivenDevicesToTheKernel) {
  HidWheelOptions options;
  HidWheel wheel(options, pressing);
  wheel.seen.kernel_has_springs = true;
  EXPECT_THAT(test::calls_of(wheel)->paths(), IsEmpty());
  wheel.seen.kernel_has_springs = false;
  EXPECT_THAT(test::calls_of(wheel)->paths(), ElementsAre(HidWheel::kPath));
  wheel.seen.descriptor = {0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0xC0};  // a mouse
  EXPECT_THAT(test::calls_of(wheel)->paths(), IsEmpty());
}

TEST(HidEvents, EndingProgramRemovesItsEffects) {
  Plugged plugged;
  plugged.run(milliseconds(1000));
  EXPECT_EQ(plugged.model.wheel.effects(), 2U);
  plugged.loop.reset();
  EXPECT_EQ(plugged.model.wheel.effects(), 0U);
  EXPECT_EQ(plugged.model.open_files(), 0);
}

// The host does nothing more: the device ends the effects, and the next program frees them.
TEST(HidEvents, KilledProgramLeavesNoForceAndNextRestarts) {
  Plugged plugged;
  plugged.run(milliseconds(1000));
  ASSERT_GT(plugged.model.wheel.force(0), 1);
  plugged.model.pass(EvdevLoop::kLength + milliseconds(1));
  EXPECT_EQ(plugged.model.wheel.force(0), 0);
  EXPECT_EQ(plugged.model.wheel.effects(), 2U);
  EvdevExchange exchange;
  EvdevLoop next(exchange, plugged.settings, test::calls_of(plugged.model),
                 [&] { return plugged.model.now(); });
  next.step(milliseconds(1));
  EXPECT_THAT(next.take_notices(), ElementsAre(HasSubstr("ready")));
  EXPECT_EQ(plugged.model.wheel.effects(), 2U) << "its own";
}

TEST(HidEvents, ReadingsContinueDuringUploads) {
  const Hand quick = [](double t) { return HidWheel::Places{0.03 * std::sin(12 * t), 0.02}; };
  for (const auto takes : {microseconds(1000), microseconds(2000), microseconds(4000)}) {
    SCOPED_TRACE(takes.count());
    HidWheelOptions options;
    options.takes = takes;
    Plugged plugged(options, quick);
    plugged.run(milliseconds(400));
    static_cast<void>(plugged.steps_without());
    double most = 0;
    const int before = plugged.model.wheel.changes();
    for (std::uint32_t i = 0; i < 300; ++i) {
      const double way = 0.02 * std::sin(0.1 * i);  // a remote hand that never rests
      plugged.servo.contacts().write(bench::only(bench::sphere({way, -0.045, 0}, 500, i + 1)));
      plugged.run(milliseconds(10));
      most = std::max(most, std::abs(plugged.model.wheel.force(0)));
      ASSERT_EQ(plugged.model.wheel.playing(), 2U);
    }
    EXPECT_EQ(plugged.steps_without(), 0);
    EXPECT_GT(most, 1.0);
    EXPECT_GT(plugged.model.wheel.changes() - before, 60);
  }
}

// Strokes that press every wall, stops, remote hands and stalls of the program. RECKON_SOAK=1 draws
// 200 of each.
TEST(HidEvents, NeverGivesUnpaidEnergy) {
  const unsigned seeds = test::tries(4U, 200U);
  double least = 0, lead = 0, greatest = 0;
  for (const auto takes : {microseconds(100), microseconds(1000), microseconds(2000)}) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << takes.count() << " us");
      HidWheelOptions options;
      options.takes = takes;
      options.answers = microseconds(seed % 3 * 400 + 100);
      options.reports = microseconds(seed % 2 == 0 ? 1000 : 4000);
      options.wheel.hand_stiffness = seed % 2 == 0 ? 300 : 900;
      test::RoamingHand hand(seed, 0.006, 0.018, 8, 4);
      Plugged plugged(options, hand);
      for (std::uint32_t i = 0; i < 16; ++i) {
        const Vector3d other(hand.within(-0.05, 0.05), hand.within(-0.05, 0.05), 0);
        plugged.servo.contacts().write(i < 13 ? bench::only(bench::sphere(other, 500, i + 1))
                                              : ContactSet());
        plugged.run(microseconds(static_cast<int>(hand.within(50e3, 350e3))));
        greatest = std::max(greatest, std::abs(plugged.model.wheel.force(0)));
        if (i % 3 == 0) plugged.stop.press(StopCause::program);
        if (i % 3 == 1) plugged.stop.release(StopCause::program);
        if (i % 5 == 2) plugged.model.pass(microseconds(static_cast<int>(hand.within(5e3, 90e3))));
      }
      plugged.run(milliseconds(4500) - plugged.model.now());
      ASSERT_LT(plugged.model.wheel.fastest(), 1.0) << "the hand is faster than stated";
      ASSERT_GE(plugged.model.wheel.least_absorbed(), -1e-9);
      least = std::min(least, plugged.model.wheel.least_absorbed());
      lead = std::max(lead, plugged.last().port_energy - plugged.model.wheel.absorbed());
    }
  }
  std::printf("  least %.3g J, the meter's lead %.3g J\n", least, lead);
  EXPECT_LE(lead, 1e-6) << "what the reports round off";
  EXPECT_GT(greatest, 3.0) << "no wall was ever pressed";
}

TEST(HidEvents, ReportsObstaclesWithTheRemedy) {
  const auto said = [](const std::function<void(HidWheel&)>& spoil, HidWheelOptions options = {}) {
    Plugged plugged(options);
    spoil(plugged.model);
    plugged.run(milliseconds(200));
    return plugged.notices.empty() ? std::string("nothing") : plugged.notices.front();
  };
  const auto with = [&](const std::function<void(test::PidWheelOptions&)>& change) {
    HidWheelOptions options;
    change(options.wheel);
    return said([](HidWheel&) {}, options);
  };
  EXPECT_THAT(said([](HidWheel& wheel) { wheel.opening = -EACCES; }),
              HasSubstr("this user may not open /dev/hidraw3: sudo reckon devices --install-rule "
                        "while it is attached"));
  EXPECT_THAT(said([](HidWheel& wheel) { wheel.is_taken = true; }),
              HasSubstr("another program has grabbed it"));
  EXPECT_THAT(said([](HidWheel& wheel) { wheel.fail(HidWheel::Call::set_feature, -EPIPE); }),
              HasSubstr("it accepts no spring effect: Broken pipe"));
  EXPECT_THAT(said([](HidWheel& wheel) { wheel.fail(HidWheel::Call::write, -EPIPE); }),
              HasSubstr("it cannot be grabbed: Broken pipe"));
  EXPECT_THAT(with([](auto& wheel) { wheel.without = {0x64}; }), HasSubstr("Saturation"));
  HidWheelOptions seldom;
  seldom.takes = milliseconds(5);
  EXPECT_THAT(said([](HidWheel&) {}, seldom), HasSubstr("it accepts a report every 5000 us"));
  EXPECT_THAT(with([](auto& wheel) { wheel.without = {0x23}; }), HasSubstr("event_axes = 1"));
  EXPECT_THAT(with([](auto& wheel) { wheel.without = {0x25}; }), HasSubstr("renders no springs"));
  EXPECT_THAT(with([](auto& wheel) { wheel.has_room_of_its_own = false; }),
              HasSubstr("no Device Managed Pool"));
  EXPECT_THAT(with([](auto& wheel) { wheel.most_effects = 1; }),
              HasSubstr("it holds 1 effects at once"));
  EXPECT_THAT(with([](auto& wheel) { wheel.most_effects = 1, wheel.without = {0x83}; }),
              HasSubstr("it has no room for two effects"));
}

TEST(HidEvents, DeviceRefusedByPathGetsAReason) {
  const auto said = [](std::vector<std::uint8_t> descriptor) {
    Plugged plugged;
    plugged.model.seen.descriptor = std::move(descriptor);
    plugged.settings.event = HidWheel::kPath;
    plugged.start();
    plugged.run(milliseconds(200));
    return plugged.notices.empty() ? std::string("nothing") : plugged.notices.front();
  };
  const std::string path = HidWheel::kPath;
  EXPECT_THAT(said({}), HasSubstr(path + ": its report descriptor cannot be read"));
  EXPECT_THAT(said({0x06, 0x01}), HasSubstr(path + ": its report descriptor is malformed"));
  EXPECT_THAT(said({0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0xC0}),
              HasSubstr(path + " has no force feedback"));
}

TEST(HidEvents, MissingOptionalUsagesAreTolerated) {
  HidWheelOptions options;
  options.wheel.without = {0x65, 0x51, 0x53, 0x54, 0xA7, 0x83, 0xA9, 0xAC};
  Plugged plugged(options);
  plugged.run(milliseconds(2000));
  EXPECT_NEAR(plugged.model.wheel.place(0), -0.02 - 0.01 * 300 / 1300, 1e-4);
}

TEST(HidEvents, AsksToMoveADeviceWithoutAPosition) {
  HidWheelOptions options;
  options.says_where = false;
  bool moves = false;
  Plugged plugged(options, [&moves](double t) {
    return HidWheel::Places{moves ? 0.01 * std::sin(10 * t) : 0, 0};
  });
  plugged.run(milliseconds(1000));
  EXPECT_THAT(plugged.notices,
              ElementsAre(HasSubstr("it reports no position before it moves: move it")));
  moves = true;
  plugged.run(milliseconds(1000));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready")));
}

TEST(HidEvents, ReportsARefusedEffectAndRetries) {
  Plugged plugged;
  plugged.run(milliseconds(1000));
  plugged.notices.clear();
  plugged.model.fail(HidWheel::Call::write, -ETIMEDOUT);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("refuses an effect (Connection timed out)")));
  EXPECT_FALSE(plugged.last().enabled);
  plugged.notices.clear();
  plugged.model.fail(HidWheel::Call::write, 0, 0);
  plugged.run(milliseconds(1000));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready")));
  plugged.model.fail(HidWheel::Call::write, -EPROTO);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices,
              Contains(HasSubstr("does not answer (Protocol error), as if unplugged")));
  EXPECT_GE(plugged.model.wheel.least_absorbed(), -1e-9);
}

}  // namespace
}  // namespace reckon::haptics::hid_events_test
