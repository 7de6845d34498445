// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Polhem behind the real libusb; a model answers the kernel's calls. All time is the model's.
// Behaviour common with other devices is tested in usb_loop_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::polhem_loop_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::PolhemModel;
using test::PolhemModelOptions;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

DeviceLimits limits(const PolhemWeights& weights = {}) {
  UsbSettings settings;
  settings.damping = 2.0;
  settings.spent_damping = polhem_spent_damping(weights);
  return usb_limits(polhem_facts(), settings);
}

Vector3d pressing(double) { return {0, 0, -0.02}; }

class Plugged : public test::PluggedDevice<PolhemModel> {
 public:
  explicit Plugged(const PolhemModelOptions& options = {},
                   std::function<Vector3d(double)> hand = pressing,
                   const PolhemWeights& weights = {})
      : PluggedDevice(options, std::move(hand), std::make_unique<PolhemDriver>(weights),
                      limits(weights)) {}

  // Until it is homed and the force has arrived.
  void press() {
    run(seconds(5));
    ASSERT_GT(model.force().z(), 0.5) << "no wall is felt";
    notices.clear();
  }
};

TEST(PolhemLoop, PositionsForcesAndTurnsHaveTheAxesSigns) {
  for (int axis = 0; axis < 3; ++axis) {
    Plugged polhem({}, [axis](double) { return Vector3d(0.02 * Vector3d::Unit(axis)); });
    polhem.servo_runs = false;
    DeviceSample sample;
    polhem.model.beside([&, next = nanoseconds(0)](nanoseconds now) mutable {
      polhem.tend();
      if (now < next) return;
      next = now + milliseconds(1);
      sample = polhem.device.read(now);
      polhem.device.write(2.0 * Vector3d::Unit(axis), now);
    });
    polhem.run(seconds(3));
    // A quarter turn of the middle axis of its gimbal, and its button.
    polhem.model.turn_gimbal({0, 256, 0});
    polhem.model.hold_button(true);
    polhem.run(seconds(1));
    ASSERT_TRUE(sample.ok);
    EXPECT_LT((sample.position - polhem.model.position()).norm(), 2e-4);
    EXPECT_LT((polhem.model.force() - 2.0 * Vector3d::Unit(axis)).norm(), 0.01);
    EXPECT_EQ(sample.buttons, 1U);
    ASSERT_TRUE(sample.turn);
    // Here the fore link hangs down, and the base is turned towards the handle.
    const Vector3d away = Vector3d(0, -0.14, 0) + polhem.model.position();
    const double base = std::atan2(away.x(), -away.y());
    const Vector3d across(std::cos(base), std::sin(base), 0);
    EXPECT_LT((sample.turn->orientation * Vector3d::UnitX() - across).norm(), 1e-2);
  }
  EXPECT_EQ(limits().axes, 3) << "it shows no torque";
}

// The device's own ledger, for all phases of its requests and answers in a frame, hands and
// weights.
TEST(PolhemLoop, NeverGivesUnpaidEnergy) {
  double least = 0, meter = -1, most_allowance = 0;
  std::uint64_t failed = 0;
  unsigned runs = 0;
  for (unsigned seed = 1; seed <= 20; seed += test::tries(5U, 1U), ++runs) {
    PolhemModelOptions options;
    options.seed = seed;
    options.out_at = 0.05 * (seed * 7 % 20);
    options.in_at = 0.05 * (seed * 3 % 20);
    options.mass = seed % 3 == 0 ? 0.5 : 0.1;
    options.hand_stiffness = 20 * seed;
    options.hand_damping = seed % 2 == 0 ? 0 : 2;  // the device itself must stop the handle
    PolhemWeights weights;
    if (seed % 4 == 0) weights = {0.17, 0.055};
    options.upper_weight = weights.upper;
    options.fore_weight = weights.fore;
    const double wave = 2 * std::numbers::pi * (0.5 + 0.3 * seed);
    Plugged polhem(
        options,
        [=](double t) {
          const double turn = wave * std::min(t, 6.0);  // then it rests
          return Vector3d(0.01 * std::sin(0.7 * turn), 0.01 * std::cos(turn),
                          0.015 * std::sin(turn) - 0.01);
        },
        weights);
    // In its start pose, when its links are supported.
    polhem.run(milliseconds(900));
    polhem.begin_books();
    polhem.run(seconds(7));
    EXPECT_THAT(polhem.notices, Contains(HasSubstr("ready"))) << "seed " << seed;
    EXPECT_GE(polhem.least_books, -1e-9) << "seed " << seed;
    const double books = polhem.books();
    EXPECT_LE(polhem.last.port_energy, books + polhem.last.encoder_allowance) << "seed " << seed;
    least = std::min(least, polhem.least_own);
    meter = std::max(meter, polhem.last.port_energy - books);
    most_allowance = std::max(most_allowance, polhem.last.encoder_allowance);
    failed += polhem.last.tally.failed;
    EXPECT_LE(polhem.last.trips, 1U) << "before it was homed, seed " << seed;
  }
  EXPECT_LE(failed, runs * 300U) << "before it was homed";
  std::printf(
      "least %.3g J without any allowance, the meter above the books by %.3g J at most, "
      "allowance to %.3g J, %llu readings failed of %u,000\n",
      least, meter, most_allowance, static_cast<unsigned long long>(failed), 8 * runs);
}

// A hand carries the weight of the links unless the motors support it.
TEST(PolhemLoop, LinksAreSupportedByTheDeclaredWeights) {
  PolhemModelOptions options;
  options.upper_weight = 0.17;
  options.fore_weight = 0.055;
  const auto above = [](double) { return Vector3d(0.01, 0.01, 0.03); };
  const auto sag = [&](const PolhemWeights& weights) {
    Plugged polhem(options, above, weights);
    polhem.run(seconds(5));
    return (polhem.model.position() - above(0)).norm();
  };
  EXPECT_GT(sag({}), 2e-3);
  EXPECT_LT(sag({0.17, 0.055}), 5e-5);
  // The support is the device's own: the servo's force is unchanged.
  Plugged pressed(options, pressing, {0.17, 0.055});
  pressed.run(seconds(5));
  const double wall = pressed.servo.static_stiffness_limit();
  EXPECT_NEAR(pressed.last.force.z(), 200 * wall / (200 + wall) * 0.02, 0.05);
  EXPECT_LT(limits({0.17, 0.055}).damping, limits().damping) << "which it costs";
  EXPECT_THROW(PolhemDriver({-1, 0}), std::invalid_argument);
  EXPECT_THROW(PolhemDriver({0, std::nan("")}), std::invalid_argument);
}

// In the air, where the servo renders nothing: the energy of the motors beyond lifting the links.
TEST(PolhemLoop, LinkSupportMakesLessThanItsDampingCosts) {
  const PolhemWeights weights{0.17, 0.055};
  double most = -1;
  for (unsigned seed = 1; seed <= 10; seed += test::tries(3U, 1U)) {
    PolhemModelOptions options;
    options.out_at = 0.05 * (seed * 7 % 20);
    options.in_at = 0.05 * (seed * 3 % 20);
    options.upper_weight = weights.upper;
    options.fore_weight = weights.fore;
    const double wave = 2 * std::numbers::pi * 0.4 * seed;
    Plugged polhem(
        options,
        [=](double t) {
          return Vector3d(0.02 * std::sin(0.7 * wave * t), 0.03 * std::cos(wave * t),
                          0.04 + 0.03 * std::sin(wave * t));
        },
        weights);
    polhem.run(milliseconds(900));
    const double before = polhem.model.port_work() + polhem.model.lifted();
    polhem.run(seconds(6));
    ASSERT_EQ(polhem.loop->stage(), UsbStage::running);
    ASSERT_TRUE(polhem.last.force.isZero(0)) << "it is in the air";
    const double made = before - (polhem.model.port_work() + polhem.model.lifted());
    const double ways = polhem.model.damping_loss() / options.damping;  // of v^2 over time
    EXPECT_LT(made, polhem_spent_damping(weights) * ways) << "seed " << seed;
    most = std::max(most, made / ways);
  }
  std::printf("holding up made as much as %.2g N s/m would take, of %.2g that it costs\n", most,
              polhem_spent_damping(weights));
}

// One and a half turns about its base: a counter of 16 bits wraps on the way.
TEST(PolhemLoop, CounterWrapsDuringMotion) {
  Plugged polhem({}, [](double t) {
    const double turn = 3 * std::numbers::pi * std::clamp((t - 4) / 6, 0.0, 1.0);
    return Vector3d(0.2 * std::sin(turn), 0.14 - 0.2 * std::cos(turn), 0.03);
  });
  polhem.run(seconds(4));
  double most = 0;
  for (int i = 0; i < 7'000; ++i) {
    polhem.run(milliseconds(1));
    ASSERT_TRUE(polhem.last.enabled) << i;
    most = std::max(most, (polhem.last.device - polhem.model.position()).norm());
  }
  EXPECT_LT(polhem.model.counts()[0], -33'000) << "beyond 16 bits";
  EXPECT_LT(most, 5e-3) << "[m]: the way of 7 ms, and no jump";
  EXPECT_THAT(polhem.notices, Not(Contains(HasSubstr("end of its range"))));
}

TEST(PolhemLoop, WithoutHomingThereIsNoForce) {
  Plugged polhem;
  polhem.model.leave_alone();
  polhem.run(seconds(2));
  EXPECT_THAT(polhem.notices, ElementsAre(HasSubstr("press its calibration button")));
  EXPECT_TRUE(polhem.motors_rest());
  EXPECT_TRUE(polhem.last.force.isZero(0));
}

TEST(PolhemLoop, CalibrationButtonZeroesTheForceWithin10Ms) {
  Plugged polhem;
  polhem.press();
  polhem.model.leave_alone();
  polhem.model.press();
  polhem.run(milliseconds(5));
  EXPECT_TRUE(polhem.motors_rest());
  // Its reports are then relative to the start pose, where it is not: an impossible reading.
  polhem.run(milliseconds(5));
  EXPECT_TRUE(polhem.last.force.isZero(0));
  EXPECT_GE(polhem.least_books, -1e-9);
}

TEST(PolhemLoop, SingleHomingRequestSetsNoCounts) {
  Plugged polhem;
  polhem.press();
  polhem.model.leave_alone();
  polhem.model.ask_once();
  polhem.run(seconds(2));
  EXPECT_LT((polhem.last.device - polhem.model.position()).norm(), 1e-4);
  EXPECT_GT(polhem.model.force().z(), 0.5);
  EXPECT_GE(polhem.least_books, -1e-9);
}

TEST(PolhemLoop, UnpluggedItMustBeHomedAgain) {
  Plugged polhem;
  polhem.press();
  polhem.model.leave_alone();
  polhem.shim.unplug();
  polhem.model.forget();
  polhem.run(milliseconds(500));
  polhem.notices.clear();
  polhem.shim.plug();
  polhem.run(seconds(2));
  EXPECT_THAT(polhem.notices, ElementsAre(HasSubstr("not homed")));
  EXPECT_TRUE(polhem.motors_rest());
}

TEST(PolhemLoop, AfterAStallItIsStillHomed) {
  Plugged polhem;
  polhem.press();
  polhem.model.stall();
  polhem.run(seconds(2));
  EXPECT_THAT(polhem.notices, Not(Contains(HasSubstr("not homed"))));
  EXPECT_GT(polhem.model.force().z(), 0.5);
}

TEST(PolhemLoop, JumpingCountersAreRefused) {
  for (const int jump : {3'000, -3'000, 32'768, 40'000}) {
    Plugged polhem;
    polhem.press();
    polhem.model.leave_alone();
    polhem.model.lie(jump);
    polhem.run(milliseconds(10));
    EXPECT_TRUE(polhem.motors_rest()) << jump;
    polhem.run(seconds(1));
    EXPECT_THAT(polhem.notices, Contains(HasSubstr("not homed"))) << jump;
    EXPECT_TRUE(polhem.motors_rest()) << jump;
    EXPECT_GE(polhem.least_books, -1e-9) << jump;
  }
}

TEST(PolhemLoop, DamagedReportsGiveNoEnergy) {
  for (unsigned seed = 1; seed <= test::tries(4U, 10U); ++seed) {
    PolhemModelOptions options;
    options.seed = seed;
    Plugged polhem(options);
    polhem.press();
    polhem.model.damage(100);
    polhem.run(seconds(1));
    polhem.run(seconds(5));
    EXPECT_GT(polhem.model.force().z(), 0.5) << seed;
    EXPECT_GE(polhem.least_books, -1e-9) << seed;
  }
}

TEST(PolhemLoop, SplitOrMergedReportsGiveNoReading) {
  for (const bool merged : {false, true}) {
    Plugged polhem;
    polhem.press();
    if (merged) {
      polhem.model.merge(1'000'000);
    } else {
      polhem.model.split(true);
    }
    polhem.run(milliseconds(20));
    EXPECT_TRUE(polhem.motors_rest()) << merged;
    EXPECT_FALSE(polhem.last.enabled) << merged;
    polhem.model.merge(0);
    polhem.model.split(false);
    polhem.run(seconds(3));
    EXPECT_GT(polhem.model.force().z(), 0.5) << merged;
    EXPECT_GE(polhem.least_books, -1e-9) << merged;
  }
}

TEST(PolhemLoop, OlderReportsAreRefusedWithTheRemedy) {
  PolhemModelOptions options;
  options.report = 8;
  Plugged polhem(options);
  polhem.run(seconds(1));
  EXPECT_THAT(polhem.notices, ElementsAre(HasSubstr("reports have 8 octets")));
  EXPECT_TRUE(polhem.motors_rest());
  EXPECT_FALSE(polhem.loop->stage());
}

TEST(PolhemLoop, ReportsOfAnotherLengthAreRefused) {
  PolhemModelOptions options;
  options.report = 12;
  Plugged polhem(options);
  polhem.run(seconds(1));
  EXPECT_THAT(polhem.notices, ElementsAre(HasSubstr("12 octets instead of 14")));
}

TEST(PolhemLoop, LeavesAnotherDeviceWithTheSameIdAlone) {
  PolhemModelOptions options;
  options.is_hid = false;
  Plugged polhem(options);
  polhem.run(seconds(1));
  EXPECT_THAT(polhem.notices, ElementsAre(HasSubstr("another device")));
  EXPECT_EQ(polhem.model.commands(), 0U);
}

}  // namespace
}  // namespace reckon::haptics::polhem_loop_test
