// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux with its thread and its servo, the kernel's calls answered by a
// model: what the hand feels, what fails, and the model's own books. All time is the model's.
#include "reckon/haptics/evdev/evdev_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/evdev_model.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
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
using ::testing::IsEmpty;
using ::testing::Not;
using Hand = std::function<EvdevModel::Places(double)>;

constexpr double kStiffness = 1000.0;

SceneObject solid(const std::string& name, const Shape& shape, const Vector3d& at) {
  SceneObject object;
  object.name = name;
  object.shape = shape;
  object.pose.position = at;
  object.effects.of<SpringDamper>().stiffness = kStiffness;
  return object;
}

// Solid where x is below -20 mm.
Scene one_wall() {
  Scene scene;
  scene.objects.push_back(solid("wall", PlaneShape{Vector3d::UnitX()}, {-0.02, 0, 0}));
  return scene;
}
// Free from -20 to 20 mm along x and y, but for a post in a corner.
Scene room() {
  Scene scene = one_wall();
  scene.objects.push_back(solid("right", PlaneShape{-Vector3d::UnitX()}, {0.02, 0, 0}));
  scene.objects.push_back(solid("front", PlaneShape{Vector3d::UnitY()}, {0, -0.02, 0}));
  scene.objects.push_back(solid("back", PlaneShape{-Vector3d::UnitY()}, {0, 0.02, 0}));
  scene.objects.push_back(solid("post", BoxShape{Vector3d::Constant(0.008)}, {0.01, 0.01, 0}));
  return scene;
}

// Pushes into the wall of one_wall() and stays 10 mm behind it.
EvdevModel::Places pressing(double t) { return {-0.03 * std::min(1.0, 2 * t), 0}; }

/// The servo steps every millisecond, beside the thread.
class Plugged {
 public:
  explicit Plugged(const Scene& scene = one_wall(), Hand hand = pressing,
                   const EvdevModelOptions& options = {}, const EvdevSettings* said = nullptr)
      : settings(said != nullptr ? *said : settings_for(options)),
        device(exchange, evdev_limits(settings)),
        servo(device, EffectPlan(scene), servo_config()) {
    auto calls = std::make_unique<EvdevModel>(options, std::move(hand));
    model = calls.get();
    loop = std::make_unique<EvdevLoop>(exchange, settings, std::move(calls),
                                       [this] { return model->now(); });
    model->beside([this](nanoseconds now) {
      if (now < next_step_) return;
      next_step_ += milliseconds(1);
      if (!servo_runs) return;
      const test::AllocationGuard guard;
      servo.step(now);
      allocations += guard.count();
      servo.snapshots().update();
    });
  }
  void run(nanoseconds time) {
    const nanoseconds end = model->now() + time;
    while (model->now() < end) {
      loop->step(milliseconds(1));
      for (std::string& notice : loop->take_notices()) notices.push_back(std::move(notice));
    }
  }
  // The program does nothing, and the device goes on.
  void hang(nanoseconds time) {
    servo_runs = false;
    model->pass(time);
    servo_runs = true;
  }
  [[nodiscard]] const ServoSnapshot& last() { return servo.snapshots().read(); }

  ForceStop stop;
  EvdevSettings settings;
  EvdevExchange exchange;
  EvdevDevice device;
  ServoLoop servo;
  EvdevModel* model = nullptr;
  std::unique_ptr<EvdevLoop> loop;
  std::vector<std::string> notices;
  bool servo_runs = true;
  std::size_t allocations = 0;  // of the servo

 private:
  ServoConfig servo_config() {
    ServoConfig config;
    config.stop = &stop;
    config.stop_button = 1;
    return config;
  }
  nanoseconds next_step_{0};
};

TEST(EvdevLoop, AWallIsFeltWhereItIsWithTheForceOfItsDepth) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  const EvdevModel& model = *plugged.model;
  const double depth = -0.02 - model.place()[0];
  EXPECT_GT(depth, 0.001);
  EXPECT_NEAR(model.force(0), kStiffness * depth, 0.01 * kStiffness * depth);
  // 300 N/m of the hand against 1,000 N/m of the wall, 10 mm apart.
  EXPECT_NEAR(depth, 0.01 * 300 / 1300, 1e-4);
  EXPECT_EQ(model.force(1), 0);
  EXPECT_NEAR(plugged.last().force.x(), model.force(0), 0.02);
  EXPECT_NEAR(plugged.last().scp.x(), -0.02, 1e-5);
  EXPECT_TRUE(plugged.last().in_mesh_contact);
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("Model wheel: ready")));
}

TEST(EvdevLoop, AWallThatStandsIsToldOnceAndNotAgain) {
  Plugged plugged;
  plugged.run(milliseconds(500));
  const int uploads = plugged.model->uploads();
  plugged.run(milliseconds(2000));
  EXPECT_EQ(plugged.model->uploads(), uploads);
  EXPECT_EQ(plugged.allocations, 0U);
  EXPECT_LT(uploads, 20);
}

TEST(EvdevLoop, TheGainIsFullAndNothingCentresTheHandle) {
  Plugged plugged;
  plugged.run(milliseconds(10));
  EXPECT_EQ(plugged.model->gain(), 0xFFFF);
  EXPECT_EQ(plugged.model->autocenter(), 0);
}

TEST(EvdevLoop, AWheelOfOneAxisFeelsTheWallsAlongIt) {
  EvdevModelOptions options;
  options.axes = 1;
  Plugged plugged(room(), pressing, options);
  plugged.run(milliseconds(2000));
  EXPECT_NEAR(plugged.model->force(0), 1000 * 0.01 * 300 / 1300, 0.05);
}

TEST(EvdevLoop, AStifferWallIsSoftenedToWhatTheDeviceShows) {
  EvdevModelOptions options;
  EvdevSettings settings = settings_for(options);
  settings.max_stiffness = 200;
  Plugged plugged(one_wall(), pressing, options, &settings);
  plugged.run(milliseconds(2000));
  EXPECT_NEAR(-0.02 - plugged.model->place()[0], 0.01 * 300 / 500, 1e-4);
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
  Plugged plugged(room(), deep, options, &settings);
  plugged.run(milliseconds(3000));
  EXPECT_GT(std::hypot(plugged.model->force(0), plugged.model->force(1)), 2.9);
  EXPECT_LE(plugged.model->greatest_force(), 3 / std::numbers::sqrt2 + 1e-9);
}

// 30 mm from the centre of a hand of 20 mm, for a probe of 10 mm: the touch.
ContactSet hand_at(const Vector3d& centre, std::uint32_t version = 1) {
  return bench::only(bench::sphere(centre, 500, version));
}

TEST(EvdevLoop, AHandOfAnotherIsFeltAlongBothAxesAtOnce) {
  const Hand oblique = [](double t) {
    const double way = std::min(1.0, 0.5 * t);
    return EvdevModel::Places{-0.03 * way, -0.04 * way};
  };
  Plugged plugged({}, oblique);
  // 50 mm from the middle, where the hand wants to be.
  plugged.servo.contacts().write(hand_at({-0.03, -0.04, 0}));
  plugged.run(milliseconds(4000));
  const EvdevModel& model = *plugged.model;
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

TEST(EvdevLoop, AHandOfAnotherDoesNotPushAHandThatNeverPressed) {
  const Hand rests = [](double) { return EvdevModel::Places{0, 0}; };
  Plugged plugged({}, rests);
  plugged.run(milliseconds(500));
  for (std::uint32_t i = 0; i < 100; ++i) {
    plugged.servo.contacts().write(hand_at({-0.05 + 0.0005 * i, 0, 0}, i + 1));
    plugged.run(milliseconds(10));
  }
  EXPECT_LT(plugged.model->greatest_force(), 0.05);
  EXPECT_GE(plugged.model->least_absorbed(), -1e-9);
}

// Strokes that press every wall, stops at random instants, and a hand that may begin in a wall.
struct Roaming {
  explicit Roaming(unsigned seed) : random(seed) {
    for (auto& axis : strokes)
      for (auto& stroke : axis) stroke = {within(0.003, 0.014), within(2, 12), within(0, 6.3)};
  }
  double within(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  }
  EvdevModel::Places operator()(double t) const {
    EvdevModel::Places place{};
    const double share = std::clamp(rests_from - t, 0.0, 1.0);
    for (std::size_t i = 0; i < 2; ++i)
      for (const auto& [size, rate, phase] : strokes[i])
        place[i] += share * size * std::sin(rate * t + phase);
    return place;
  }
  double rests_from = 5;  // [s], in the middle, where nothing is touched
  std::mt19937 random;
  std::array<std::array<std::array<double, 3>, 3>, 2> strokes{};
};

struct Told {
  double least = 0, greatest = 0, fastest = 0;
  double lead = 0;  // [J], of the servo's meter before the device's own books, at the end
};

// Of a run of 4 s, and a rest.
Told roam(unsigned seed, microseconds report, microseconds latency, double stiffness_of_hand) {
  EvdevModelOptions options;
  options.seed = seed;
  options.report = report;
  options.latency = latency;
  options.hand_stiffness = stiffness_of_hand;
  options.ends_effects = seed % 3 != 0;
  options.takes = seed % 2 == 0 ? milliseconds(1) : microseconds(125);
  options.misses_turns = seed > 3;
  Roaming hand(seed);
  Plugged plugged(room(), hand, options);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Vector3d other(hand.within(-0.06, 0.06), hand.within(-0.06, 0.06), 0);
    plugged.servo.contacts().write(i < 17 ? hand_at(other, i + 1) : ContactSet());
    plugged.run(microseconds(static_cast<int>(hand.within(50e3, 350e3))));
    if (i % 3 == 0) plugged.stop.press(StopCause::program);
    if (i % 3 == 1) plugged.stop.release(StopCause::program);
    if (i % 5 == 2) plugged.hang(microseconds(static_cast<int>(hand.within(5e3, 120e3))));
  }
  plugged.run(milliseconds(5500) - plugged.model->now());
  const EvdevModel& model = *plugged.model;
  return {model.least_absorbed(), model.greatest_force(), model.fastest(),
          plugged.last().port_energy - model.absorbed()};
}

// RECKON_SOAK=1 draws 120 of each.
TEST(EvdevLoop, NeverGivesMoreEnergyThanTheHandPutIn) {
  const unsigned seeds = std::getenv("RECKON_SOAK") != nullptr ? 120 : 6;
  Told all;
  for (const auto report : {microseconds(1000), microseconds(4000), microseconds(8000)}) {
    for (const auto latency : {microseconds(0), microseconds(2000), microseconds(8000)}) {
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        const Told one = roam(seed, report, latency, seed % 2 == 0 ? 300 : 900);
        ASSERT_LT(one.fastest, 1.0) << "the hand is faster than stated";
        ASSERT_GE(one.least, -1e-9) << "seed " << seed << ", report " << report.count()
                                    << " us, latency " << latency.count() << " us";
        ASSERT_LE(one.lead, 1e-9) << "seed " << seed;
        all.greatest = std::max(all.greatest, one.greatest);
        all.least = std::min(all.least, one.least);
      }
    }
  }
  RecordProperty("least_J", std::to_string(all.least));
  EXPECT_GT(all.greatest, 3.0) << "no wall was ever pressed";
}

// Nearly always at the greatest speed that is stated, through walls and hands of others. Of the
// changes of each step the device's own springs get no more than was booked.
TEST(EvdevLoop, NoChangeCostsMoreThanIsBookedThoughTheHandIsAlwaysAsFastAsStated) {
  const unsigned seeds = std::getenv("RECKON_SOAK") != nullptr ? 120 : 4;
  constexpr double kSpeed = 0.4;  // [m/s]
  const Hand brisk = [](double t) {
    const double turn = std::numbers::pi / 0.06 * 0.9 * kSpeed / 0.95;
    const double begun = t < 1 ? t * t / 2 : t - 0.5;
    const double way = 0.06 / std::numbers::pi * std::asin(0.95 * std::sin(turn * begun));
    return EvdevModel::Places{way, -way};
  };
  double greatest = 0;
  for (const auto report : {milliseconds(1), milliseconds(4), milliseconds(8)}) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      EvdevModelOptions options;
      options.seed = seed;
      options.report = report;
      options.takes = milliseconds(1);
      options.misses_turns = seed % 2 == 0;
      options.hand_stiffness = 20e3;
      options.hand_damping = 100;
      EvdevSettings settings = settings_for(options);
      settings.max_speed = kSpeed;
      settings.chain = 2 * report + 4 * options.takes + WallEffects::kReaction;
      Plugged plugged(room(), brisk, options, &settings);
      Roaming others(seed);
      const auto booked = [&] {
        plugged.exchange.reading.update();
        return plugged.exchange.reading.read().shown.energy;
      };
      struct Step {
        int changes;
        double cost;  // [J], as it was booked
      };
      std::vector<Step> steps;
      std::uint32_t number = 0;
      for (int until = 0, i = 0; i < 4000; ++i) {
        if (i == until) {
          const Vector3d other(others.within(-0.06, 0.06), others.within(-0.06, 0.06), 0);
          plugged.servo.contacts().write(++number % 4 != 3 ? hand_at(other, number) : ContactSet());
          until += static_cast<int>(others.within(10, 100));
        }
        const int uploads = plugged.model->uploads();
        const double energy = booked();
        plugged.run(milliseconds(1));
        if (plugged.model->uploads() > uploads)
          steps.push_back({plugged.model->uploads() - uploads, energy - booked()});
      }
      plugged.model->pass(milliseconds(50));
      const std::vector<double>& rises = plugged.model->rises();
      std::size_t told = 0;
      for (const Step& step : steps) {
        double rise = 0;
        for (int i = 0; i < step.changes; ++i) rise += rises.at(told++);
        ASSERT_LE(rise, step.cost + 1e-9) << "seed " << seed << ", report " << report.count()
                                          << " ms, change " << told << " of " << rises.size();
      }
      ASSERT_LT(plugged.model->fastest(), kSpeed);
      greatest = std::max(greatest, plugged.model->greatest_force());
    }
  }
  EXPECT_GT(greatest, 3.0) << "no wall was ever pressed";
}

// Walls far away on both sides of a hand that never rests; they rest for 40 ms of each 100. What
// the device is told, and how late after the place that this follows from it does that at most.
struct Line {
  nanoseconds slowest{0};
  int uploads = 0;
  std::vector<std::string> notices;
  double below = 0, above = 0;  // how far the newest wall of each side is from what was asked [m]
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
    if (model.now() < milliseconds(100)) continue;  // it is set up
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

TEST(EvdevLoop, AChangeIsThereWithinItsDelayHoweverOftenWallsChange) {
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
        // Each side is as new as the other: a wall goes 0.8 m/s at most.
        EXPECT_LT(line.below, 0.03);
        EXPECT_LT(line.above, 0.03);
        EXPECT_GT(line.uploads, 150);
      }
    }
  }
}

TEST(EvdevLoop, WhatDoesNotTellHowOftenItTakesAReportHasAMillisecondForEach) {
  EvdevModelOptions options;
  options.takes = milliseconds(1);
  const Line line = line_of(options, milliseconds(10), false);
  EXPECT_LE(line.slowest, milliseconds(10));
  EXPECT_GT(line.uploads, 150);
  // Or what the stated delay leaves for each.
  options.takes = microseconds(125);
  const Line quick = line_of(options, microseconds(2500), false);
  EXPECT_THAT(quick.notices, Contains(HasSubstr("ready")));
  EXPECT_LE(quick.slowest, microseconds(2500));
  EXPECT_THAT(line_of(options, milliseconds(1), false).notices,
              ::testing::ElementsAre(HasSubstr("a delay of 2 ms or more")));
}

TEST(EvdevLoop, OneThatIsTooSlowForItsDelayIsRefusedWithTheDelayThatServes) {
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

TEST(EvdevLoop, AHandleThatTellsItsPlaceSeldomDoesNotMoveInSteps) {
  for (const auto report : {milliseconds(1), milliseconds(4), milliseconds(8)}) {
    EvdevModelOptions options;
    options.report = report;
    const Hand quick = [](double t) { return EvdevModel::Places{0.06 * std::sin(10 * t), 0}; };
    Plugged plugged(Scene(), quick, options);
    plugged.run(milliseconds(500));
    double fastest = 0, truth = 0;
    for (int i = 0; i < 1000; ++i) {
      const double from = plugged.model->place()[0];
      plugged.run(milliseconds(1));
      truth = std::max(truth, std::abs(plugged.model->place()[0] - from) / 1e-3);
      ASSERT_TRUE(plugged.last().enabled) << report.count() << " ms";
      fastest = std::max(fastest, plugged.last().device_velocity.norm());
    }
    EXPECT_GT(truth, 0.6);
    EXPECT_NEAR(fastest, truth, 0.05 * truth) << report.count() << " ms";
  }
}

TEST(EvdevLoop, UnpluggedItShowsNothingAndIsTakenUpByItself) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  plugged.notices.clear();
  plugged.model->plug(false);
  plugged.run(milliseconds(20));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("was unplugged")));
  EXPECT_EQ(plugged.model->open_files(), 0);
  EXPECT_FALSE(plugged.last().enabled);
  EXPECT_EQ(plugged.last().force, Vector3d::Zero());
  plugged.run(milliseconds(2000));
  plugged.notices.clear();
  plugged.model->plug(true);
  plugged.run(milliseconds(600));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready")));
  plugged.run(milliseconds(1000));
  // The hand was in the wall: it begins where the hand was.
  EXPECT_GE(plugged.model->least_absorbed(), -1e-9);
}

TEST(EvdevLoop, ItIsSaidOnceThatItIsNotThere) {
  Plugged plugged;
  plugged.model->plug(false);
  plugged.run(milliseconds(3000));
  ASSERT_EQ(plugged.notices.size(), 1U);
  EXPECT_THAT(plugged.notices[0], HasSubstr("no device with force feedback is attached"));
}

TEST(EvdevLoop, AServoThatIsSilentLeavesNoWalls) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  ASSERT_GT(plugged.model->force(0), 1);
  plugged.servo_runs = false;
  plugged.run(milliseconds(13));
  EXPECT_EQ(plugged.model->force(0), 0);
}

TEST(EvdevLoop, AProgramThatHangsLeavesNoWallsAfterTheLengthOfAnEffect) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  ASSERT_GT(plugged.model->force(0), 1);
  plugged.hang(EvdevLoop::kLength + milliseconds(1));
  EXPECT_EQ(plugged.model->force(0), 0);
  plugged.run(milliseconds(20));
  EXPECT_GE(plugged.model->least_absorbed(), -1e-9);
}

TEST(EvdevLoop, WhereItsThreadStandsStillNothingIsShownAfterTheLengthOfAnEffect) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  plugged.model->pass(milliseconds(12));
  EXPECT_FALSE(plugged.last().enabled);
  EXPECT_GT(plugged.model->force(0), 1);
  EXPECT_GT(plugged.last().force.x(), 1) << "the device shows it still";
  plugged.model->pass(EvdevLoop::kLength);
  EXPECT_EQ(plugged.model->force(0), 0);
  EXPECT_EQ(plugged.last().force, Vector3d::Zero());
}

TEST(EvdevLoop, AProgramThatEndsTakesItsEffectsWithIt) {
  const EvdevModelOptions options;
  const auto calls = std::make_unique<EvdevModel>(options, pressing);
  EvdevModel* const model = calls.get();
  struct Shared final : EventCalls {
    explicit Shared(EvdevModel& m) : model(m) {}
    std::vector<std::string> paths() override { return model.paths(); }
    std::string closed_name(const std::string& path) override { return model.closed_name(path); }
    ReportIntervals report_intervals(const std::string& path) override {
      return model.report_intervals(path);
    }
    int open(const std::string& path) override { return model.open(path); }
    void close(int file) noexcept override { model.close(file); }
    int control(int f, unsigned long r, void* a) noexcept override {
      return model.control(f, r, a);
    }
    int read(int f, std::span<input_event> e) noexcept override { return model.read(f, e); }
    int write(int f, const input_event& e) noexcept override { return model.write(f, e); }
    void wait(int f, microseconds t) noexcept override { model.wait(f, t); }
    EvdevModel& model;
  };
  EvdevExchange exchange;
  {
    EvdevLoop loop(exchange, settings_for(options), std::make_unique<Shared>(*model),
                   [model] { return model->now(); });
    for (int i = 0; i < 50; ++i) loop.step(milliseconds(1));
    ASSERT_EQ(model->effects(), 2U);
  }
  model->pass(milliseconds(2));
  EXPECT_EQ(model->effects(), 0U);
  EXPECT_EQ(model->open_files(), 0);
}

TEST(EvdevLoop, TheSoftwareStopTakesTheWallsOff) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  ASSERT_GT(plugged.model->force(0), 1);
  plugged.model->press(BTN_THUMB, true);  // the second button
  plugged.run(milliseconds(5));
  EXPECT_EQ(plugged.model->force(0), 0);
  EXPECT_TRUE(plugged.last().stopped);
}

TEST(EvdevLoop, DroppedEventsAreAskedForAgain) {
  Plugged plugged;
  plugged.run(milliseconds(1500));
  for (int i = 0; i < 20; ++i) {
    plugged.model->drop_events();
    plugged.run(milliseconds(20));
    EXPECT_NEAR(plugged.last().device.x(), plugged.model->place()[0], 1e-4);
  }
  EXPECT_EQ(plugged.last().trips, 0U);
}

TEST(EvdevLoop, AHandThatIsFasterThanStatedFeelsNothing) {
  EvdevModelOptions options;
  EvdevSettings settings = settings_for(options);
  settings.max_speed = 0.2;
  const Hand stroke = [](double t) { return EvdevModel::Places{-0.03 * std::sin(20 * t), 0}; };
  Plugged plugged(one_wall(), stroke, options, &settings);
  plugged.run(milliseconds(2000));
  EXPECT_GT(plugged.last().trips, 0U);
}

TEST(EvdevLoop, AnEffectThatIsRefusedIsSaidAndTriedAgain) {
  Plugged plugged;
  plugged.run(milliseconds(2000));
  plugged.notices.clear();
  plugged.model->fail(EVIOCSFF, EIO);
  plugged.stop.press(StopCause::program);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("refuses an effect")));
  EXPECT_EQ(plugged.model->force(0), 0);
  plugged.model->fail(EVIOCSFF, 0);
  plugged.run(milliseconds(1000));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready")));
}

TEST(EvdevLoop, AWriteThatHasToWaitIsMadeAgain) {
  Plugged plugged;
  plugged.run(milliseconds(1990));
  plugged.model->fail_writes(EAGAIN);
  plugged.run(milliseconds(15));
  plugged.model->fail_writes(0);
  plugged.run(milliseconds(500));
  EXPECT_THAT(plugged.notices, Not(Contains(HasSubstr("refuses"))));
  EXPECT_GT(plugged.model->force(0), 1);
}

struct Way {
  const char* said;
  std::function<void(EvdevModel&)> wrong;
};

TEST(EvdevLoop, WhatIsInTheWayIsSaidWithTheRemedy) {
  const Way ways[] = {
      {"sudo usermod -aG input", [](EvdevModel& m) { m.opening = -EACCES; }},
      {"another program has it for itself", [](EvdevModel& m) { m.fail(EVIOCGRAB, EBUSY); }},
      {"only forces that it is told", [](EvdevModel& m) { m.without = {FF_SPRING}; }},
      {"it shakes at most",
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
    way.wrong(*plugged.model);
    plugged.run(milliseconds(1200));
    EXPECT_EQ(plugged.notices.size(), 1U) << way.said;
    EXPECT_THAT(plugged.notices, Contains(HasSubstr(way.said)));
    EXPECT_EQ(plugged.model->open_files(), 0) << way.said;
    EXPECT_FALSE(plugged.last().enabled);
  }
}

TEST(EvdevLoop, AnAxisThatIsNotThereIsSaid) {
  EvdevModelOptions options;
  options.axes = 1;
  EvdevSettings settings = settings_for(options);
  settings.axes = 2;
  Plugged plugged(room(), pressing, options, &settings);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("ABS_Y: say event_axes = 1")));
}

TEST(EvdevLoop, ADeviceIsFoundByAPartOfItsNameOrItsPath) {
  for (const char* event : {"wheel", "Model", "/dev/input/event7"}) {
    EvdevSettings settings = settings_for({});
    settings.event = event;
    Plugged plugged(one_wall(), pressing, {}, &settings);
    plugged.model->others = {"/dev/input/event0"};
    plugged.run(milliseconds(100));
    EXPECT_THAT(plugged.notices, Contains(HasSubstr("ready"))) << event;
  }
  EvdevSettings settings = settings_for({});
  settings.event = "joystick";
  Plugged plugged(one_wall(), pressing, {}, &settings);
  plugged.run(milliseconds(100));
  EXPECT_THAT(plugged.notices, Contains(HasSubstr("whose name has 'joystick'")));
}

TEST(EvdevLimits, WhatNoDeviceTellsIsAskedForByItsKey) {
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

TEST(EventDevices, AreThoseWithForceFeedbackAndThoseThatMayNotBeOpened) {
  EvdevModel model({}, pressing);
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
}  // namespace reckon::haptics
