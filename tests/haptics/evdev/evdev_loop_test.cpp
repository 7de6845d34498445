// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux with its thread and its servo; a model answers the kernel's
// calls: the forces at the hand, and their delay. All time is the model's.
#include "reckon/haptics/evdev/evdev_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "reckon/tests/haptics/support/plugged_events.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::evdev_loop_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::EvdevModel;
using test::EvdevModelOptions;
using test::settings_for;
using ::testing::Contains;
using ::testing::HasSubstr;
using Plugged = test::PluggedWheel;
using Hand = Plugged::Hand;

TEST(EvdevLoop, WallHasTheForceOfItsDepth) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  const EvdevModel& model = plugged.model;
  const double depth = -0.02 - model.place()[0];
  EXPECT_GT(depth, 0.001);
  EXPECT_NEAR(model.force(0), 1'000.0 * depth, 0.01 * 1'000.0 * depth);
  // 300 N/m of the hand against 1,000 N/m of the wall, 10 mm apart.
  EXPECT_NEAR(depth, 0.01 * 300 / 1300, 1e-4);
  EXPECT_EQ(model.force(1), 0);
  EXPECT_NEAR(plugged.last().force.x(), model.force(0), 0.02);
  EXPECT_NEAR(plugged.last().scp.x(), -0.02, 1e-5);
  EXPECT_TRUE(plugged.last().in_mesh_contact);
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("Model wheel: ready")));
}

TEST(EvdevLoop, RestingWallIsUploadedOnce) {
  Plugged plugged;
  plugged.run(milliseconds(500));
  const int uploads = plugged.model.uploads();
  plugged.run(milliseconds(2000));
  EXPECT_EQ(plugged.model.uploads(), uploads);
  EXPECT_EQ(plugged.allocations, 0U);
  EXPECT_LT(uploads, 20);
}

TEST(EvdevLoop, SetsFullGainAndNoAutocentre) {
  Plugged plugged;
  plugged.run(milliseconds(10));
  EXPECT_EQ(plugged.model.gain(), 0xFFFF);
  EXPECT_EQ(plugged.model.autocenter(), 0);
}

TEST(EvdevLoop, WheelOfOneAxisFeelsWallsAlongIt) {
  EvdevModelOptions options;
  options.axes = 1;
  Plugged plugged(test::room_with_post(), Plugged::pressing, options);
  plugged.run(milliseconds(2000));
  EXPECT_NEAR(plugged.model.force(0), 1000 * 0.01 * 300 / 1300, 0.05);
}

TEST(EvdevLoop, StiffWallIsSoftenedToTheDevicesLimit) {
  EvdevModelOptions options;
  EvdevSettings settings = settings_for(options);
  settings.max_stiffness = 200;
  Plugged plugged(test::one_wall(), Plugged::pressing, options, &settings);
  plugged.run(milliseconds(2000));
  EXPECT_NEAR(-0.02 - plugged.model.place()[0], 0.01 * 300 / 500, 1e-4);
  EXPECT_EQ(plugged.servo.static_stiffness_limit(), 200);
}

TEST(EvdevLoop, NoForceIsAboveTheLimit) {
  EvdevModelOptions options;
  options.hand_stiffness = 1000;
  EvdevSettings settings = settings_for(options);
  settings.max_force = 3;
  const Hand deep = [](double t) {
    return EvdevModel::Places{-0.04 * std::min(1.0, t), -0.04 * std::min(1.0, t)};
  };
  Plugged plugged(test::room_with_post(), deep, options, &settings);
  plugged.run(milliseconds(3000));
  EXPECT_GT(std::hypot(plugged.model.force(0), plugged.model.force(1)), 2.9);
  EXPECT_LE(plugged.model.greatest_force(), 3 / std::numbers::sqrt2 + 1e-9);
}

// 30 mm from the centre of a hand of 20 mm, for a probe of 10 mm: the touch.
ContactSet hand_at(const Vector3d& centre, std::uint32_t version = 1) {
  return bench::only(bench::sphere(centre, 500, version));
}

TEST(EvdevLoop, RemoteHandIsFeltAlongBothAxes) {
  const Hand oblique = [](double t) {
    const double way = std::min(1.0, 0.5 * t);
    return EvdevModel::Places{-0.03 * way, -0.04 * way};
  };
  Plugged plugged({}, oblique);
  // 50 mm from the middle, the hand's goal.
  plugged.servo.contacts().write(hand_at({-0.03, -0.04, 0}));
  plugged.run(milliseconds(4000));
  const EvdevModel& model = plugged.model;
  const Vector3d away = Vector3d(model.place()[0], model.place()[1], 0) - Vector3d(-0.03, -0.04, 0);
  const double depth = 0.03 - away.norm();
  EXPECT_GT(depth, 0.005);
  const Vector3d force(model.force(0), model.force(1), 0);
  EXPECT_NEAR(force.norm(), 500 * depth, 0.02 * 500 * depth);
  EXPECT_LT((force.normalized() - away.normalized()).norm(), 0.02);
  // 300 N/m of the hand over 30 mm against 500 N/m.
  EXPECT_NEAR(depth, 0.03 * 300 / 800, 2e-4);
  ASSERT_EQ(plugged.last().count, 1U);
  EXPECT_NEAR(plugged.last().contacts[0].depth, depth, 1e-4);
  EXPECT_NEAR(plugged.last().contacts[0].force.norm(), force.norm(), 0.05 * force.norm());
  EXPECT_GE(model.least_absorbed(), -1e-9);
}

TEST(EvdevLoop, RemoteHandDoesNotPushAnUnpressedHand) {
  const Hand rests = [](double) { return EvdevModel::Places{0, 0}; };
  Plugged plugged({}, rests);
  plugged.run(milliseconds(500));
  for (std::uint32_t i = 0; i < 100; ++i) {
    plugged.servo.contacts().write(hand_at({-0.05 + 0.0005 * i, 0, 0}, i + 1));
    plugged.run(milliseconds(10));
  }
  EXPECT_LT(plugged.model.greatest_force(), 0.05);
  EXPECT_GE(plugged.model.least_absorbed(), -1e-9);
}

// Walls far away on both sides of a hand that never rests; they rest for 40 ms of each 100. Records
// the uploads and their largest delay after the position that caused them.
struct Line {
  nanoseconds slowest{0};
  int uploads = 0;
  std::vector<std::string> notices;
  double below = 0, above = 0;  // distance of the newest wall of each side from the requested one
                                // [m]
};

Line line_of(const EvdevModelOptions& options, nanoseconds chain, bool tells_interval = true) {
  EvdevSettings settings = settings_for(options);
  settings.chain = chain;
  EvdevExchange exchange;
  EvdevDevice device(exchange, evdev_limits(settings));
  auto calls = std::make_unique<EvdevModel>(options, [](double t) {
    return EvdevModel::Places{0.005 * std::cos(10 * t), 0.005 * std::sin(10 * t)};
  });
  EvdevModel& model = *calls;
  model.tells_interval = tells_interval;
  EvdevLoop loop(exchange, settings, std::move(calls), [&] { return model.now(); });
  Line line;
  SpringModel asked;
  while (model.now() < std::chrono::seconds(4)) {
    const double time = std::chrono::duration<double>(model.now()).count();
    const double times = std::floor(time / 0.1);
    const double t = 0.06 * times + std::min(time - 0.1 * times, 0.06);
    asked.wall(0, WallSide::below) = {-0.06 - 0.02 * std::sin(40 * t), 1000, 10};
    asked.wall(0, WallSide::above) = {0.06 + 0.02 * std::cos(40 * t), 1000, 10};
    device.state(asked, model.now());
    loop.step(milliseconds(1));
    for (std::string& notice : loop.take_notices()) line.notices.push_back(std::move(notice));
    if (model.now() < milliseconds(100)) continue;  // during set-up
    static_cast<void>(device.read(model.now()));
    const SpringModel shown = device.shown().model;
    line.below = std::max(line.below, std::abs(shown.wall(0, WallSide::below).at -
                                               asked.wall(0, WallSide::below).at));
    line.above = std::max(line.above, std::abs(shown.wall(0, WallSide::above).at -
                                               asked.wall(0, WallSide::above).at));
  }
  line.uploads = model.uploads();
  line.slowest = model.slowest_change();
  return line;
}

TEST(EvdevLoop, ChangesArriveWithinTheirDelay) {
  for (const auto takes : {microseconds(125), microseconds(1000), microseconds(2000)}) {
    for (const auto report : {milliseconds(1), milliseconds(4)}) {
      for (const bool misses : {false, true}) {
        SCOPED_TRACE(::testing::Message() << takes.count() << ", " << report.count() << misses);
        EvdevModelOptions options;
        options.takes = takes;
        options.report = report;
        options.misses_turns = misses;
        const nanoseconds least = 2 * report + 4 * takes + WallEffects::kReaction;
        const Line line = line_of(options, least);
        EXPECT_LE(line.slowest, least);
        // Both sides are equally recent: a wall moves at most 0.8 m/s.
        EXPECT_LT(line.below, 0.03);
        EXPECT_LT(line.above, 0.03);
        EXPECT_GT(line.uploads, 150);
      }
    }
  }
}

TEST(EvdevLoop, UnknownReportIntervalIsTakenAsAMillisecond) {
  EvdevModelOptions options;
  options.takes = milliseconds(1);
  const Line line = line_of(options, milliseconds(10), false);
  EXPECT_LE(line.slowest, milliseconds(10));
  EXPECT_GT(line.uploads, 150);
  // Or the share of the declared delay for each.
  options.takes = microseconds(125);
  const Line quick = line_of(options, microseconds(2500), false);
  EXPECT_THAT(quick.notices, Contains(HasSubstr("ready")));
  EXPECT_LE(quick.slowest, microseconds(2500));
  EXPECT_THAT(line_of(options, milliseconds(1), false).notices,
              ::testing::ElementsAre(HasSubstr("a delay of 2 ms or more")));
}

TEST(EvdevLoop, SlowDeviceIsRefusedWithASuitableDelay) {
  EvdevModelOptions options;
  options.takes = milliseconds(4);
  const Line refused = line_of(options, milliseconds(8));
  EXPECT_THAT(refused.notices, ::testing::ElementsAre(HasSubstr("a delay of 19 ms or more")));
  EXPECT_EQ(refused.uploads, 0);
  const Line taken = line_of(options, milliseconds(19));
  EXPECT_THAT(taken.notices, Contains(HasSubstr("ready")));
  EXPECT_LE(taken.slowest, milliseconds(19));

  EvdevModelOptions seldom;
  seldom.takes = milliseconds(1);
  seldom.report = milliseconds(8);
  EXPECT_THAT(line_of(seldom, milliseconds(8)).notices,
              ::testing::ElementsAre(HasSubstr("a delay of 21 ms or more")));
  const Line known_late = line_of(seldom, milliseconds(21));
  EXPECT_THAT(known_late.notices, Contains(HasSubstr("ready")));
  EXPECT_LE(known_late.slowest, milliseconds(21));
}

TEST(EvdevLoop, SeldomReportedHandleMovesWithoutSteps) {
  for (const auto report : {milliseconds(1), milliseconds(4), milliseconds(8)}) {
    EvdevModelOptions options;
    options.report = report;
    const Hand quick = [](double t) { return EvdevModel::Places{0.06 * std::sin(10 * t), 0}; };
    Plugged plugged(Scene(), quick, options);
    plugged.run(milliseconds(500));
    double fastest = 0, truth = 0;
    for (int i = 0; i < 1000; ++i) {
      const double from = plugged.model.place()[0];
      plugged.run(milliseconds(1));
      truth = std::max(truth, std::abs(plugged.model.place()[0] - from) / 1e-3);
      ASSERT_TRUE(plugged.last().enabled) << report.count() << " ms";
      fastest = std::max(fastest, plugged.last().device_velocity.norm());
    }
    EXPECT_GT(truth, 0.6);
    EXPECT_NEAR(fastest, truth, 0.05 * truth) << report.count() << " ms";
  }
}

}  // namespace
}  // namespace reckon::haptics::evdev_loop_test
