// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program itself at a wheel that the kernel drives: usbhid and hid-pidff on one side, the event
// device on the other. One wheel and one boot serve all tests, in their order. Time is that of an
// emulated machine, which is slow and uneven: what takes long is told, and judged by seconds alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/tests/haptics/support/usbip_wheel.hpp"
#include "reckon/tests/haptics/support/vm_program.hpp"

namespace reckon::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

// Of that scene: a wall whose outside is where x is greater, and where the hand goes [m].
constexpr double kStiffness = 700;  // [N/m]
constexpr double kWall = -0.00513, kOutside = 0.04, kInside = -0.035;
// Where a hand of 300 N/m rests that wants to be there.
constexpr double kRest = kWall + (kInside - kWall) * 300 / (300 + kStiffness);

// What the reports round off: a wall begins at a whole number of ten thousandths of 0.125 m, and a
// coefficient is a whole number of ten thousandths of 2,000 N/m, or 0.2 N/m.
constexpr double kPlaceStep = 12.5e-6, kStiffnessStep = 0.2;

class EvdevVm : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!std::filesystem::exists(UsbipDevice::kBus) || !std::filesystem::exists(kProgram)) return;
    wheel = std::make_unique<UsbipWheel>(PidWheelOptions{});
    go(kOutside);
    wheel->plug_in();
  }
  static void TearDownTestSuite() { wheel.reset(); }
  void SetUp() override {
    if (wheel == nullptr) GTEST_SKIP() << "runs in the virtual machine of ./run devices-vm alone";
  }

  static void go(double place) {
    wheel->with([&](PidWheel& one) { one.want(0, place); });
  }
  static double force() {
    return wheel->with([](PidWheel& one) { return one.force(0); });
  }
  static double place() {
    return wheel->with([](PidWheel& one) { return one.place(0); });
  }
  static std::size_t playing() {
    return wheel->with([](PidWheel& one) { return one.playing(); });
  }
  static std::size_t effects() {
    return wheel->with([](PidWheel& one) { return one.effects(); });
  }
  static bool rests_at(double goal, double within) {
    return wheel->with([&](PidWheel& one) {
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
  static void expect_the_wall(std::size_t axis = 0, double wall = kWall) {
    const auto [at, shown] =
        wheel->with([&](PidWheel& one) { return std::pair(one.place(axis), one.force(axis)); });
    const double depth = std::abs(at - wall), force = shown * (at < wall ? 1 : -1);
    EXPECT_GT(depth, 0.003);
    EXPECT_NEAR(force, kStiffness * depth, kStiffness * kPlaceStep + kStiffnessStep * depth);
    std::printf("  %.4f N at %.4f mm in the wall: %.3f N/m of %.0f\n", force, 1e3 * depth,
                force / depth, kStiffness);
  }
  static std::unique_ptr<Program> start(std::vector<std::string> words = {"peer", "/wall.toml",
                                                                          "--iface", "lo"}) {
    words.insert(words.end(), {"--device", "evdev", "--json", "--for", "600s"});
    auto program = std::make_unique<Program>(std::move(words));
    EXPECT_TRUE(comes_true([] { return playing() == 2; })) << program->said();
    std::this_thread::sleep_for(milliseconds(500));  // its greatest force has risen
    return program;
  }

  static std::unique_ptr<UsbipWheel> wheel;
};

std::unique_ptr<UsbipWheel> EvdevVm::wheel;

TEST_F(EvdevVm, TheKernelDrivesItAndReckonSaysHowItIsUsed) {
  ASSERT_TRUE(comes_true([] { return std::filesystem::exists("/dev/input/event0"); }));
  Program program({"devices"});
  EXPECT_EQ(program.wait(), 0);
  const std::string said = program.said();
  std::printf("%s", said.c_str());
  EXPECT_THAT(said, HasSubstr(UsbipWheel::kProduct));
  EXPECT_THAT(said, HasSubstr("renders walls by itself along an axis"));
}

TEST_F(EvdevVm, AWallIsRenderedWithItsStiffness) {
  const auto program = start();
  for (int i = 0; i < 4; ++i) {
    press();
    expect_the_wall();
    retreat();
  }
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  std::printf("%s", program->said().c_str());
}

TEST_F(EvdevVm, AProgramThatEndsTakesItsEffectsWithIt) {
  const auto program = start();
  press();
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0) << program->said();
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
  EXPECT_EQ(force(), 0);
  retreat();
}

TEST_F(EvdevVm, OneThatIsKilledLeavesNoneEither) {
  const auto program = start();
  press();
  program->send(SIGKILL);
  const double took = milliseconds_until([] { return force() == 0; });
  EXPECT_EQ(program->wait(), 128 + SIGKILL);
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
  std::printf("  killed: no force after %.1f ms\n", took);
  retreat();
}

TEST_F(EvdevVm, OneThatHangsLeavesNoForceOnceItsEffectsEnd) {
  const auto program = start();
  press();
  program->send(SIGSTOP);
  const double took = milliseconds_until([] { return force() == 0; });
  std::printf("  stopped: no force after %.1f ms\n", took);
  EXPECT_TRUE(comes_true([] { return playing() == 0; }));
  EXPECT_EQ(effects(), 2U);
  retreat();
  program->send(SIGCONT);
  ASSERT_TRUE(comes_true([] { return playing() == 2; }));
  press();
  expect_the_wall();
  retreat();
}

TEST_F(EvdevVm, UnpluggedItShowsNothingAndIsTakenUpAgain) {
  const auto program = start();
  press();
  wheel->unplug();
  EXPECT_EQ(force(), 0);
  const double said = milliseconds_until([&] { return program->has_said("was unplugged"); });
  std::printf("  unplugged: said after %.1f ms\n", said);
  retreat();
  wheel->plug_in();
  const double took = milliseconds_until([] { return playing() == 2; });
  std::printf("  plugged in again: set up after %.0f ms\n", took);
  press();
  expect_the_wall();
  retreat();
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0) << program->said();
}

TEST_F(EvdevVm, AHandPressesThoseOfOthersOnBothSides) {
  const auto program = start({"demo", "/hands.toml", "--peers", "3", "--even-if-slow"});
  const int before = wheel->with([](PidWheel& one) { return one.changes(); });
  double least = 0, most = 0;
  for (int i = 0; i < 12; ++i) {
    go(i % 2 == 0 ? -0.03 : 0.03);
    EXPECT_FALSE(comes_true(
        [&] {
          least = std::min(least, force());
          most = std::max(most, force());
          return false;
        },
        seconds(1)));
  }
  std::printf("  %.2f N to %.2f N, %d changes in 12 s\n", least, most,
              wheel->with([](PidWheel& one) { return one.changes(); }) - before);
  EXPECT_LT(least, -1);
  EXPECT_GT(most, 1);
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  std::printf("%s", program->said().c_str());
  retreat();
}

// Walls on both sides that never rest, as far away as costs nothing.
TEST_F(EvdevVm, AChangeComesWithinItsDelayHoweverManyThereAre) {
  go(0);
  haptics::EvdevExchange exchange;
  haptics::EvdevSettings settings;
  settings.event = UsbipWheel::kProduct;
  settings.axes = 1;
  settings.scale = {0.25, 15, 2000};
  settings.max_stiffness = 800;
  haptics::EvdevDevice device(exchange, haptics::evdev_limits(settings));
  haptics::EvdevLoop loop(exchange, settings, haptics::kernel_event_calls(), UsbipDevice::now);
  ASSERT_TRUE(comes_true([&] {
    loop.step(milliseconds(1));
    return playing() == 2;
  }));
  const int before = wheel->with([](PidWheel& one) { return one.changes(); });
  const auto begin = UsbipDevice::now();
  while (UsbipDevice::now() - begin < seconds(4)) {
    const double time = std::chrono::duration<double>(UsbipDevice::now() - begin).count();
    haptics::SpringModel model;
    model.wall(0, haptics::WallSide::below) = {-0.07 - 0.02 * std::sin(40 * time), 700, 10};
    model.wall(0, haptics::WallSide::above) = {0.07 + 0.02 * std::cos(40 * time), 700, 10};
    device.state(model, UsbipDevice::now());
    loop.step(milliseconds(1));
  }
  const auto last = UsbipDevice::now();
  std::this_thread::sleep_for(seconds(1));
  wheel->with([&](PidWheel& one) {
    std::printf("  %d changes in 4 s, the last of them there %.1f ms after it was told\n",
                one.changes() - before, milliseconds_of(one.told() - last));
    EXPECT_LT(one.told() - last, settings.chain);
    EXPECT_GT(one.changes() - before, 700);
  });
}

// All that was done to it.
TEST_F(EvdevVm, TheWheelNeverGaveMoreEnergyThanTheHandPutIn) {
  wheel->with([](PidWheel& one) {
    std::printf("  %.6f J taken, %.3g J at least; %.3f m/s at most; %d changes\n", one.absorbed(),
                one.least_absorbed(), one.fastest(), one.changes());
    EXPECT_GE(one.least_absorbed(), -1e-6);
    EXPECT_EQ(one.strange(), 0);
  });
}

// Walls below along x and above along y.
TEST_F(EvdevVm, AStickFeelsWallsAlongBothItsAxes) {
  constexpr double kCeiling = 0.007;
  PidWheelOptions options;
  options.axes = 2;
  wheel.reset();
  wheel = std::make_unique<UsbipWheel>(options);
  go(kOutside);
  wheel->plug_in();
  const auto program = start({"peer", "/corner.toml", "--iface", "lo"});
  EXPECT_TRUE(comes_true([] { return rests_at(kOutside, 1e-4); }));
  wheel->with([](PidWheel& one) {
    one.want(0, -0.02);
    one.want(1, 0.022);
  });
  EXPECT_TRUE(comes_true([] {
    return wheel->with([](PidWheel& one) {
      return one.force(0) > 3 && one.force(1) < -3 && std::hypot(one.speed(0), one.speed(1)) < 1e-5;
    });
  }));
  expect_the_wall();
  expect_the_wall(1, kCeiling);
  wheel->with([](PidWheel& one) {
    one.want(0, kOutside);
    one.want(1, 0);
  });
  EXPECT_TRUE(comes_true([] { return rests_at(kOutside, 1e-4); }));
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
  wheel->with([](PidWheel& one) {
    EXPECT_GE(one.least_absorbed(), -1e-6);
    EXPECT_EQ(one.strange(), 0);
  });
}

}  // namespace
}  // namespace reckon::test
