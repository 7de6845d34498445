// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A wheel with its own report layout gets springs as its descriptor defines.
#include "reckon/haptics/hid/pid_reports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/pid_wheel.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;
using test::PidWheel;
using test::PidWheelOptions;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

PidReports reports_of(const PidWheelOptions& options) {
  const auto read = hid_reports(PidWheel(options).descriptor());
  EXPECT_TRUE(read);
  return PidReports(read.value_or(HidReports{}));
}

constexpr EffectScale kWheelScale{0.25, 15, 2000};  // of PidWheelOptions

class Told : public ::testing::Test {
 protected:
  void SetUp() override {
    wheel.run_until(now);
    wheel.take(reports.control(PidControl::enable)->span());
    wheel.take(reports.gain()->span());
    wheel.take(reports.create().span());
    const PidLoad load = reports.read_load(*wheel.feature(reports.load().span()[0]));
    ASSERT_EQ(load.outcome, PidLoad::Outcome::done);
    block = load.block;
    wheel.take(reports.set_effect(block, milliseconds(60)).span());
  }
  void tell(std::size_t axis, const SpringWall& wall, WallSide side) {
    wheel.take(reports.set_condition(block, axis, condition_of(wall, side, kWheelScale)).span());
  }
  // The hand holds the handle there, as far as 300 N/m permit.
  void press(std::size_t axis, double place) {
    wheel.want(axis, place);
    for (int i = 0; i < 300; ++i) {
      wheel.take(reports.operate(block, PidOperation::start).span());
      wheel.run_until(now += milliseconds(10));
    }
  }

  PidWheel wheel{{.axes = 2}};
  PidReports reports = reports_of({.axes = 2});
  std::uint8_t block = 0;
  std::chrono::nanoseconds now = milliseconds(1);
};

TEST_F(Told, WallHasItsPositionStiffnessAndMaximum) {
  tell(0, {-0.0125, 700, 7.5}, WallSide::below);
  tell(1, {0.02, 400, 5}, WallSide::above);
  press(0, -0.0225);
  press(1, 0.03);
  EXPECT_NEAR(wheel.place(0), -0.0125 - 0.003, 2e-5) << "300 N/m against 700, 10 mm apart";
  EXPECT_NEAR(wheel.force(0), 2.1, 0.01);
  EXPECT_NEAR(wheel.force(1), -300 * 0.01 * 400 / 700, 0.01);
  press(0, -0.1);
  EXPECT_NEAR(wheel.force(0), 7.5, 2e-3) << "a step of 1.5 mN";
  EXPECT_EQ(wheel.strange(), 0);
}

TEST_F(Told, EffectEndsAndIsStoppedAndFreed) {
  tell(0, {0.02, 700, 7.5}, WallSide::below);
  press(0, 0);
  EXPECT_GT(wheel.force(0), 1);
  wheel.run_until(now += milliseconds(61));
  EXPECT_EQ(wheel.force(0), 0);
  press(0, 0);
  EXPECT_GT(wheel.force(0), 1);
  wheel.take(reports.operate(block, PidOperation::stop).span());
  EXPECT_EQ(wheel.force(0), 0);
  wheel.take(reports.free(block)->span());
  EXPECT_EQ(wheel.effects(), 0U);
  wheel.take(reports.control(PidControl::stop_all)->span());
  wheel.take(reports.control(PidControl::reset)->span());
  EXPECT_EQ(wheel.strange(), 0);
}

// A word of a report by the wheel's own layout, in its steps.
int word(const HidReport& report, std::size_t at) {
  return static_cast<std::int16_t>(report.span()[at] | report.span()[at + 1] << 8);
}

TEST_F(Told, NoWallIsNearerStifferOrStronger) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 20'000; ++i) {
    const WallSide side = i % 2 == 0 ? WallSide::below : WallSide::above;
    const SpringWall wall{0.125 * any(random), 1000 * (1 + any(random)), 7.5 * (1 + any(random))};
    const HidReport report = reports.set_condition(block, 0, condition_of(wall, side, kWheelScale));
    const double at = word(report, 3) / PidWheel::kSteps * 0.125;
    const std::size_t coefficient = side == WallSide::below ? 7 : 5,
                      most = side == WallSide::below ? 11 : 9;
    if (word(report, coefficient) == 0) continue;
    ASSERT_LE(word(report, coefficient) / PidWheel::kSteps * 2000, wall.stiffness);
    ASSERT_GT(word(report, coefficient) / PidWheel::kSteps * 2000, wall.stiffness - 0.3);
    ASSERT_LE(word(report, most) / PidWheel::kSteps * 15, wall.most);
    ASSERT_GT(word(report, most) / PidWheel::kSteps * 15, wall.most - 0.003);
    ASSERT_LT(std::abs(at - wall.at), 20e-6);
    if (side == WallSide::below) {
      ASSERT_LE(at, wall.at + 1e-12);
    } else {
      ASSERT_GE(at, wall.at - 1e-12);
    }
    ASSERT_EQ(word(report, side == WallSide::below ? 5U : 7U), 0) << "the other side is free";
  }
}

TEST_F(Told, ReadsPositionsAndButtons) {
  HidPlaces places{{5, 5}, {}, 3};
  press(0, 0.0625);
  press(1, -0.025);
  EXPECT_TRUE(reports.take(wheel.input(), places));
  EXPECT_NEAR(places.axes[0], 0.5 * 32767, 20);
  EXPECT_NEAR(places.axes[1], -0.2 * 32767, 20);
  EXPECT_EQ(places.buttons, 0U);
  std::vector<std::uint8_t> report = wheel.input();
  report[1] = 0b101;
  EXPECT_TRUE(reports.take(report, places));
  EXPECT_EQ(places.buttons, 0b101U);
  const HidPlaces before = places;
  EXPECT_FALSE(reports.take(std::vector<std::uint8_t>{2, 0, 0}, places)) << "its state";
  EXPECT_FALSE(reports.take({}, places));
  EXPECT_EQ(places, before);
  EXPECT_TRUE(reports.take(std::span(report).first(4), places)) << "cut short: its first axis";
  EXPECT_EQ(places.axes, before.axes);
}

TEST_F(Told, UsesNoHeap) {
  const test::AllocationGuard guard;
  HidPlaces places;
  const auto condition = condition_of({0.01, 700, 7}, WallSide::below, kWheelScale);
  static_cast<void>(reports.set_condition(block, 1, condition));
  static_cast<void>(reports.operate(block, PidOperation::start));
  static_cast<void>(reports.set_effect(block, milliseconds(60)));
  static_cast<void>(reports.read_load(std::array<std::uint8_t, 5>{10, 1, 1, 0, 0}));
  static_cast<void>(reports.take(std::array<std::uint8_t, 6>{1, 1, 2, 3, 4, 5}, places));
  EXPECT_EQ(guard.count(), 0U);
}

TEST_F(Told, LoadOutcomeIsReadFromTheDevicesReport) {
  const auto outcome = [&](std::vector<std::uint8_t> report) {
    return reports.read_load(report).outcome;
  };
  EXPECT_EQ(outcome({10, 1, 1, 0, 0}), PidLoad::Outcome::done);
  EXPECT_EQ(outcome({10, 0, 1, 0, 0}), PidLoad::Outcome::none) << "an effect has a number";
  EXPECT_EQ(outcome({10, 0, 2, 0, 0}), PidLoad::Outcome::full);
  EXPECT_EQ(outcome({10, 0, 3, 0, 0}), PidLoad::Outcome::failed);
  EXPECT_EQ(outcome({10, 1, 0, 0, 0}), PidLoad::Outcome::none) << "not yet";
  EXPECT_EQ(outcome({9, 1, 1, 0, 0}), PidLoad::Outcome::none) << "another report";
  EXPECT_EQ(outcome({10}), PidLoad::Outcome::none);
  EXPECT_EQ(outcome({}), PidLoad::Outcome::none);
}

TEST(PidReports, ReportRequiredUsagesThatAreMissing) {
  const auto fault = [](std::vector<int> without) {
    return reports_of({.axes = 2, .without = std::move(without)}).fault();
  };
  EXPECT_THAT(fault({}), IsEmpty());
  // Dead band, sample period, trigger, delay, gain, direction, loops, pool: all are optional.
  EXPECT_THAT(fault({0x65, 0x51, 0x53, 0x54, 0xA7, 0x52, 0x56, 0x7C, 0x83, 0xA9, 0x7E, 0xAC}),
              IsEmpty());
  EXPECT_THAT(fault({0x50}), HasSubstr("Duration"));
  EXPECT_THAT(fault({0x60}), HasSubstr("CP Offset"));
  EXPECT_THAT(fault({0x61}), HasSubstr("coefficient of each side"));
  EXPECT_THAT(fault({0x62}), HasSubstr("coefficient of each side"));
  EXPECT_THAT(fault({0x63}), HasSubstr("Saturation"));
  EXPECT_THAT(fault({0x64}), HasSubstr("Saturation"));
  EXPECT_THAT(fault({0x8B}), HasSubstr("PID Block Load"));
  EXPECT_THAT(fault({0x78}), HasSubstr("start and stop"));
  EXPECT_THAT(fault({0x22}), HasSubstr("PID Block Load"));
  EXPECT_FALSE(reports_of({.axes = 2, .without = {0x25}}).has_springs());
  const PidReports one = reports_of({.axes = 2, .without = {0x23}});
  EXPECT_THAT(one.fault(), IsEmpty());
  EXPECT_TRUE(one.axes()[0]);
  EXPECT_FALSE(one.axes()[1]) << "which nothing names in a condition";
}

TEST(PidReports, MouseGivesNoForces) {
  // The boot mouse of the class definition.
  const std::vector<std::uint8_t> mouse{0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0x09, 0x01, 0xA1, 0x00,
                                        0x05, 0x09, 0x19, 0x01, 0x29, 0x03, 0x15, 0x00, 0x25, 0x01,
                                        0x95, 0x03, 0x75, 0x01, 0x81, 0x02, 0x95, 0x01, 0x75, 0x05,
                                        0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15, 0x81,
                                        0x25, 0x7F, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xC0, 0xC0};
  const PidReports reports(*hid_reports(mouse));
  EXPECT_FALSE(reports.gives_forces());
  EXPECT_FALSE(reports.has_springs());
}

// X in report 1, Y in report 2.
TEST(PidReports, AxisIsKnownAfterItsReport) {
  const std::vector<std::uint8_t> descriptor{0x05, 0x01, 0x09, 0x04, 0xA1, 0x01, 0x15, 0x00, 0x26,
                                             0xFF, 0x03, 0x75, 0x10, 0x95, 0x01, 0x85, 0x01, 0x09,
                                             0x30, 0x81, 0x02, 0x85, 0x02, 0x09, 0x31, 0x81, 0x02,
                                             // A condition with a field for its axis.
                                             0x05, 0x0F, 0x09, 0x5F, 0xA1, 0x02, 0x85, 0x03, 0x09,
                                             0x23, 0x25, 0x01, 0x75, 0x08, 0x91, 0x02, 0xC0, 0xC0};
  const auto read = hid_reports(descriptor);
  ASSERT_TRUE(read);
  const PidReports reports(*read);
  EXPECT_EQ(reports.place_report(1).span()[0], 2);
  EXPECT_EQ(reports.place_report(1).span().size(), 3U);
  HidPlaces places;
  EXPECT_TRUE(reports.take(std::vector<std::uint8_t>{1, 0x34, 0x02}, places));
  EXPECT_EQ(places.axes[0], 0x234);
  EXPECT_TRUE(places.is_known[0]);
  EXPECT_FALSE(places.is_known[1]);
  EXPECT_TRUE(reports.take(std::vector<std::uint8_t>{2, 0xFF, 0x03}, places));
  EXPECT_TRUE(places.is_known[1]);
  EXPECT_EQ(places.axes[0], 0x234);
}

// A length is in the unit of its field: 60 ms are 600 tenths of a millisecond.
TEST(PidReports, LengthUsesTheUnitOfItsField) {
  std::vector<std::uint8_t> descriptor = PidWheel({}).descriptor();
  const std::vector<std::uint8_t> duration{0x09, 0x50, 0x15, 0x00, 0x26, 0xFF, 0x7F};
  const auto at =
      std::search(descriptor.begin(), descriptor.end(), duration.begin(), duration.end());
  ASSERT_NE(at, descriptor.end());
  const auto length_with = [&](std::vector<std::uint8_t> unit) {
    auto with = descriptor;
    with.insert(with.begin() + (at - descriptor.begin()), unit.begin(), unit.end());
    const PidReports reports(*hid_reports(with));
    return reports.fault().empty() ? word(reports.set_effect(1, milliseconds(60)), 3) : -1;
  };
  EXPECT_EQ(length_with({}), 60);
  EXPECT_EQ(length_with({0x66, 0x01, 0x10, 0x55, 0x0D}), 60);   // 10^-3 s
  EXPECT_EQ(length_with({0x66, 0x01, 0x10, 0x55, 0x0C}), 600);  // 10^-4 s
  EXPECT_EQ(length_with({0x66, 0x01, 0x10, 0x55, 0x0E}), 6);    // 10^-2 s
  EXPECT_EQ(length_with({0x66, 0x01, 0x10, 0x55, 0x00}), -1) << "whole seconds say no 60 ms";
  EXPECT_EQ(length_with({0x66, 0x01, 0x10, 0x55, 0x0A}), -1) << "60,000 us are beyond its most";
}

}  // namespace
}  // namespace reckon::haptics
