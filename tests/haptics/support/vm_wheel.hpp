// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand at an emulated wheel and the program that renders its forces, of ./run devices-vm: the
// common part of all tests of a wheel or stick. Each test program has one wheel, and one boot.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/usbip_wheel.hpp"
#include "reckon/tests/haptics/support/vm_program.hpp"

namespace reckon::test {

class VmWheel : public ::testing::Test {
 protected:
  // From /wall.toml: a wall with its outside at greater x, and the hand's goals [m].
  static constexpr double kStiffness = 700;  // [N/m]
  static constexpr double kWall = -0.00513, kOutside = 0.04, kInside = -0.035;
  // Rest position of a hand of 300 N/m with that goal.
  static constexpr double kRest = kWall + (kInside - kWall) * 300 / (300 + kStiffness);

  // Plugs a wheel in; nothing outside the virtual machine.
  static void plug_in(const PidWheelOptions& options) {
    if (!std::filesystem::exists(UsbipDevice::kBus) || !std::filesystem::exists(kProgram)) return;
    wheel.reset();
    wheel = std::make_unique<UsbipWheel>(options);
    go(kOutside);
    wheel->plug_in();
  }
  static void TearDownTestSuite() { wheel.reset(); }
  void SetUp() override {
    if (wheel == nullptr) GTEST_SKIP() << "runs in the virtual machine of ./run devices-vm alone";
  }

  template <class Use>
  static auto with(Use&& use) {
    return wheel->with(use);
  }
  static void go(double place) {
    with([&](PidWheel& one) { one.want(0, place); });
  }
  static double force() {
    return with([](PidWheel& one) { return one.force(0); });
  }
  static double place() {
    return with([](PidWheel& one) { return one.place(0); });
  }
  static std::size_t playing() {
    return with([](PidWheel& one) { return one.playing(); });
  }
  static std::size_t effects() {
    return with([](PidWheel& one) { return one.effects(); });
  }
  static int changes() {
    return with([](PidWheel& one) { return one.changes(); });
  }
  static bool rests_at(double goal, double within) {
    return with([&](PidWheel& one) {
      return std::abs(one.speed(0)) < 1e-5 && std::abs(one.place(0) - goal) < within;
    });
  }
  static void retreat() {
    go(kOutside);
    ASSERT_TRUE(comes_true([] { return rests_at(kOutside, 0.001); }));
    EXPECT_EQ(force(), 0);
  }
  // The hand presses until it rests.
  static void press() {
    go(kInside);
    ASSERT_TRUE(comes_true([] { return rests_at(kRest, 1e-4); }))
        << place() << " m, " << force() << " N";
  }
  // Within the rounding of the reports: a wall begins at a whole number of ten thousandths of 0.125
  // m, and a coefficient is a whole number of ten thousandths of 2,000 N/m, or 0.2 N/m.
  static void expect_the_wall(std::size_t axis = 0, double wall = kWall) {
    const auto [at, shown] =
        with([&](PidWheel& one) { return std::pair(one.place(axis), one.force(axis)); });
    const double depth = std::abs(at - wall), force = shown * (at < wall ? 1 : -1);
    EXPECT_GT(depth, 0.003);
    EXPECT_NEAR(force, kStiffness * depth, kStiffness * 12.5e-6 + 0.2 * depth);
    std::printf("  %.4f N at %.4f mm in the wall: %.3f N/m of %.0f\n", force, 1e3 * depth,
                force / depth, kStiffness);
  }
  static std::unique_ptr<Program> start(std::vector<std::string> words = {"peer", "/wall.toml",
                                                                          "--iface", "lo"}) {
    words.insert(words.end(), {"--device", "evdev", "--json", "--for", "600s"});
    auto program = std::make_unique<Program>(std::move(words));
    EXPECT_TRUE(comes_true([] { return playing() == 2; })) << program->said();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // its greatest force has risen
    return program;
  }
  // After all of the above.
  static void expect_no_energy_from_the_wheel() {
    with([](PidWheel& one) {
      std::printf("  %.6f J taken, %.3g J at least; %.3f m/s at most; %d changes\n", one.absorbed(),
                  one.least_absorbed(), one.fastest(), one.changes());
      EXPECT_GE(one.least_absorbed(), -1e-6);
      EXPECT_EQ(one.strange(), 0);
    });
  }

  static inline std::unique_ptr<UsbipWheel> wheel;
};

}  // namespace reckon::test
