// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program itself with a wheel driven by the kernel: usbhid and hid-pidff on one side, the event
// device on the other. One wheel and one boot serve all tests, in their order. An emulated machine
// is slow and uneven: measured times are printed, and judged only by seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/tests/haptics/support/vm_wheel.hpp"

namespace reckon::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

class EvdevVm : public VmWheel {
 protected:
  static void SetUpTestSuite() { plug_in({}); }
};

TEST_F(EvdevVm, KernelDrivesItAndReckonListsIt) {
  ASSERT_TRUE(comes_true([] { return std::filesystem::exists("/dev/input/event0"); }));
  Program program({"devices"});
  EXPECT_EQ(program.wait(), 0);
  const std::string said = program.said();
  std::printf("%s", said.c_str());
  EXPECT_THAT(said, HasSubstr(UsbipWheel::kProduct));
  EXPECT_THAT(said, HasSubstr("renders walls itself along one axis"));
}

TEST_F(EvdevVm, WallIsRenderedWithItsStiffness) {
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

TEST_F(EvdevVm, EndingProgramRemovesItsEffects) {
  const auto program = start();
  press();
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0) << program->said();
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
  EXPECT_EQ(force(), 0);
  retreat();
}

TEST_F(EvdevVm, KilledProgramLeavesNoEffects) {
  const auto program = start();
  press();
  program->send(SIGKILL);
  const double took = milliseconds_until([] { return force() == 0; });
  EXPECT_EQ(program->wait(), 128 + SIGKILL);
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
  std::printf("  killed: no force after %.1f ms\n", took);
  retreat();
}

TEST_F(EvdevVm, HungProgramLeavesNoForce) {
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

TEST_F(EvdevVm, RecoversAfterAnUnplug) {
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

TEST_F(EvdevVm, HandPressesRemoteHandsOnBothSides) {
  const auto program = start({"demo", "/hands.toml", "--peers", "3", "--even-if-slow"});
  const int before = changes();
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
  std::printf("  %.2f N to %.2f N, %d changes in 12 s\n", least, most, changes() - before);
  EXPECT_LT(least, -1);
  EXPECT_GT(most, 1);
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  std::printf("%s", program->said().c_str());
  retreat();
}

// Walls on both sides that never rest, far enough to cost nothing.
TEST_F(EvdevVm, ChangesArriveWithinTheirDelay) {
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
  const int before = changes();
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
  with([&](PidWheel& one) {
    std::printf("  %d changes in 4 s, the last of them there %.1f ms after it was told\n",
                one.changes() - before, milliseconds_of(one.told() - last));
    EXPECT_LT(one.told() - last, settings.chain);
    EXPECT_GT(one.changes() - before, 700);
  });
}

TEST_F(EvdevVm, WheelNeverGaveUnpaidEnergy) { expect_no_energy_from_the_wheel(); }

// Walls below along x and above along y.
TEST_F(EvdevVm, StickFeelsWallsAlongBothAxes) {
  constexpr double kCeiling = 0.007;
  PidWheelOptions options;
  options.axes = 2;
  plug_in(options);
  const auto program = start({"peer", "/corner.toml", "--iface", "lo"});
  EXPECT_TRUE(comes_true([] { return rests_at(kOutside, 1e-4); }));
  with([](PidWheel& one) {
    one.want(0, -0.02);
    one.want(1, 0.022);
  });
  EXPECT_TRUE(comes_true([] {
    return with([](PidWheel& one) {
      return one.force(0) > 3 && one.force(1) < -3 && std::hypot(one.speed(0), one.speed(1)) < 1e-5;
    });
  }));
  expect_the_wall();
  expect_the_wall(1, kCeiling);
  with([](PidWheel& one) {
    one.want(0, kOutside);
    one.want(1, 0);
  });
  EXPECT_TRUE(comes_true([] { return rests_at(kOutside, 1e-4); }));
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
  expect_no_energy_from_the_wheel();
}

}  // namespace
}  // namespace reckon::test
