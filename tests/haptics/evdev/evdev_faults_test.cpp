// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Faults of a force feedback device of Linux and obstacles in its way: the effects on hand and
// user. All time is the model's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <stdexcept>
#include <string>

#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/tests/haptics/support/plugged_events.hpp"

namespace reckon::haptics::evdev_faults_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using test::EvdevModel;
using test::EvdevModelOptions;
using test::settings_for;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Plugged = test::PluggedWheel;
using Hand = Plugged::Hand;

TEST(EvdevLoop, RecoversAfterAnUnplug) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  plugged.notices.clear();
  plugged.model.plug(false);
  plugged.run(milliseconds(20));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("was unplugged")));
  EXPECT_EQ(plugged.model.open_files(), 0);
  EXPECT_FALSE(plugged.last().enabled);
  EXPECT_EQ(plugged.last().force, Vector3d::Zero());
  plugged.run(milliseconds(2000));
  plugged.notices.clear();
  plugged.model.plug(true);
  plugged.run(milliseconds(600));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready")));
  plugged.run(milliseconds(1000));
  // The hand was in the wall: it begins at the hand's position.
  EXPECT_GE(plugged.model.least_absorbed(), -1e-9);
}

TEST(EvdevLoop, ReportsAMissingDeviceOnce) {
  Plugged plugged;
  plugged.model.plug(false);
  plugged.run(milliseconds(3000));
  ASSERT_EQ(plugged.notices.size(), 1U);
  EXPECT_THAT(plugged.notices[0], HasSubstr("no device with force feedback is attached"));
}

TEST(EvdevLoop, SilentServoLeavesNoWalls) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  ASSERT_GT(plugged.model.force(0), 1);
  plugged.servo_runs = false;
  plugged.run(milliseconds(13));
  EXPECT_EQ(plugged.model.force(0), 0);
}

TEST(EvdevLoop, HungProgramLeavesNoWalls) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  ASSERT_GT(plugged.model.force(0), 1);
  plugged.hang(EvdevLoop::kLength + milliseconds(1));
  EXPECT_EQ(plugged.model.force(0), 0);
  plugged.run(milliseconds(20));
  EXPECT_GE(plugged.model.least_absorbed(), -1e-9);
}

TEST(EvdevLoop, StoppedThreadLeavesNoWalls) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  plugged.model.pass(milliseconds(12));
  EXPECT_FALSE(plugged.last().enabled);
  EXPECT_GT(plugged.model.force(0), 1);
  EXPECT_GT(plugged.last().force.x(), 1) << "the device shows it still";
  plugged.model.pass(EvdevLoop::kLength);
  EXPECT_EQ(plugged.model.force(0), 0);
  EXPECT_EQ(plugged.last().force, Vector3d::Zero());
}

TEST(EvdevLoop, EndingProgramRemovesItsEffects) {
  Plugged plugged;
  plugged.run(milliseconds(50));
  ASSERT_EQ(plugged.model.effects(), 2U);
  plugged.loop.reset();
  plugged.model.pass(milliseconds(2));
  EXPECT_EQ(plugged.model.effects(), 0U);
  EXPECT_EQ(plugged.model.open_files(), 0);
}

TEST(EvdevLoop, SoftwareStopRemovesTheWalls) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  ASSERT_GT(plugged.model.force(0), 1);
  plugged.model.press(BTN_THUMB, true);  // the second button
  plugged.run(milliseconds(5));
  EXPECT_EQ(plugged.model.force(0), 0);
  EXPECT_TRUE(plugged.last().stopped);
}

TEST(EvdevLoop, QueriesTheStateAfterDroppedEvents) {
  Plugged plugged;
  plugged.run(milliseconds(1500));
  for (int i = 0; i < 20; ++i) {
    plugged.model.drop_events();
    plugged.run(milliseconds(20));
    EXPECT_NEAR(plugged.last().device.x(), plugged.model.place()[0], 1e-4);
  }
  EXPECT_EQ(plugged.last().trips, 0U);
}

TEST(EvdevLoop, HandFasterThanDeclaredFeelsNothing) {
  EvdevModelOptions options;
  EvdevSettings settings = settings_for(options);
  settings.max_speed = 0.2;
  const Hand stroke = [](double t) { return EvdevModel::Places{-0.03 * std::sin(20 * t), 0}; };
  Plugged plugged(test::one_wall(), stroke, options, &settings);
  plugged.run(milliseconds(2000));
  EXPECT_GT(plugged.last().trips, 0U);
}

TEST(EvdevLoop, ReportsARefusedEffectAndRetries) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  plugged.notices.clear();
  plugged.model.fail(EVIOCSFF, EIO);
  plugged.stop.press(StopCause::program);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("refuses an effect")));
  EXPECT_EQ(plugged.model.force(0), 0);
  plugged.model.fail(EVIOCSFF, 0);
  plugged.run(milliseconds(1000));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready")));
}

TEST(EvdevLoop, RetriesAWriteThatWouldBlock) {
  Plugged plugged;
  plugged.run(milliseconds(1990));
  plugged.model.fail_writes(EAGAIN);
  plugged.run(milliseconds(15));
  plugged.model.fail_writes(0);
  plugged.run(milliseconds(500));
  EXPECT_THAT(plugged.notices, Not(Contains(HasSubstr("refuses"))));
  EXPECT_GT(plugged.model.force(0), 1);
}

struct Way {
  const char* said;
  std::function<void(EvdevModel&)> wrong;
};

TEST(EvdevLoop, ReportsObstaclesWithTheRemedy) {
  const Way ways[] = {
      {"sudo usermod -aG input", [](EvdevModel& m) { m.opening = -EACCES; }},
      {"another program has grabbed it", [](EvdevModel& m) { m.fail(EVIOCGRAB, EBUSY); }},
      {"it renders constant forces only", [](EvdevModel& m) { m.without = {FF_SPRING}; }},
      {"which walls need",
       [](EvdevModel& m) {
         m.without = {FF_SPRING, FF_CONSTANT};
       }},
      {"holds 1 effects at once", [](EvdevModel& m) { m.most_effects = 1; }},
      {"no room for two effects", [](EvdevModel& m) { m.fail(EVIOCSFF, ENOSPC); }},
      {"it plays no spring",
       [](EvdevModel& m) {
         m.without = {FF_GAIN, FF_AUTOCENTER};
         m.fail_writes(EIO);
       }},
      {"its gain cannot be set", [](EvdevModel& m) { m.fail_writes(EIO); }},
  };
  for (const Way& way : ways) {
    Plugged plugged;
    way.wrong(plugged.model);
    plugged.run(milliseconds(1200));
    EXPECT_EQ(plugged.notices.size(), 1U) << way.said;
    EXPECT_THAT(plugged.notices, Contains(HasSubstr(way.said)));
    EXPECT_EQ(plugged.model.open_files(), 0) << way.said;
    EXPECT_FALSE(plugged.last().enabled);
  }
}

TEST(EvdevLoop, ReportsAMissingAxis) {
  EvdevModelOptions options;
  options.axes = 1;
  EvdevSettings settings = settings_for(options);
  settings.axes = 2;
  Plugged plugged(test::four_walls(), Plugged::pressing, options, &settings);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ABS_Y: write event_axes = 1")));
}

TEST(EvdevLoop, FindsADeviceByNameOrPath) {
  for (const char* event : {"wheel", "Model", "/dev/input/event7"}) {
    EvdevSettings settings = settings_for({});
    settings.event = event;
    Plugged plugged(test::one_wall(), Plugged::pressing, {}, &settings);
    plugged.model.others = {"/dev/input/event0"};
    plugged.run(milliseconds(100));
    EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready"))) << event;
  }
  EvdevSettings settings = settings_for({});
  settings.event = "joystick";
  Plugged plugged(test::one_wall(), Plugged::pressing, {}, &settings);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("a name that contains 'joystick'")));
}

TEST(EvdevLimits, UnknownLimitsAreRequestedByTheirKeys) {
  const EvdevSettings good = settings_for({});
  EXPECT_NO_THROW(evdev_limits(good));
  const auto without = [&](const char* key, const std::function<void(EvdevSettings&)>& take) {
    EvdevSettings settings = good;
    take(settings);
    try {
      static_cast<void>(evdev_limits(settings));
      FAIL() << key;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(key));
    }
  };
  without("'travel'", [](EvdevSettings& s) { s.scale.travel = 0; });
  without("'full_force'", [](EvdevSettings& s) { s.scale.full_force = 0; });
  without("'full_stiffness'", [](EvdevSettings& s) { s.scale.full_stiffness = 0; });
  without("'max_stiffness'", [](EvdevSettings& s) { s.max_stiffness = 0; });
  without("'event_axes'", [](EvdevSettings& s) { s.axes = 3; });
}

TEST(EventDevices, ListForceFeedbackAndUnopenableDevices) {
  EvdevModel model({}, Plugged::pressing);
  model.others = {"/dev/input/event0"};
  auto seen = event_devices(model);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].facts.name, "Model wheel");
  EXPECT_EQ(fault_of(seen[0].facts, 2), "");
  EXPECT_EQ(model.open_files(), 0);
  model.opening = -EACCES;
  seen = event_devices(model);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].remedy, kEventRemedy);
  EXPECT_EQ(seen[0].facts.name, "Model wheel");
}

}  // namespace
}  // namespace reckon::haptics::evdev_faults_test
