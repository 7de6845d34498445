// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The calls themselves, as a program makes them to the kernel: a wheel behind a device of umockdev
// answers them with the octets that the kernel would pass on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/hidraw.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/hid/hid_events.hpp"
#include "reckon/tests/haptics/support/mocked_node.hpp"
#include "reckon/tests/haptics/support/pid_wheel.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

class MockedWheel : public test::MockedNode {
 public:
  MockedWheel() : MockedNode("hidraw3", "hidraw", "/devices/wheel/hidraw/hidraw3") {}

  test::PidWheel wheel{{}};
  bool is_gone = false;

 private:
  long write(std::span<const std::uint8_t> report) override {
    if (is_gone) return -ENODEV;
    wheel.take(Octets(report.begin(), report.end()));
    return static_cast<long>(report.size());
  }
  long read(Octets& report) override {
    if (is_gone || wheel.input() == sent_) return is_gone ? -EIO : -EAGAIN;
    report = sent_ = wheel.input();
    return static_cast<long>(report.size());
  }
  long control(const Request& request) override {
    if (is_gone) return -ENODEV;
    if (request.is(HIDIOCGRAWINFO)) return 0;
    if (request.is(HIDIOCGINPUT(0))) return request.give(wheel.input());
    if (request.is(HIDIOCGFEATURE(0))) {
      const auto report = wheel.feature(request.octets().at(0));
      return report ? request.give(*report) : -EPIPE;
    }
    if (!request.is(HIDIOCSFEATURE(0))) return -ENOTTY;
    wheel.take(request.octets());
    return static_cast<long>(request.size());
  }

  Octets sent_;
};

TEST(HidKernel, CallsCarryTheReports) {
  if (std::getenv("LD_PRELOAD") == nullptr) GTEST_SKIP() << "runs under umockdev-wrapper alone";
  MockedWheel mock;
  const test::ScratchFolder facts;
  std::filesystem::create_directories(facts.file("hidraw3/device"));
  std::ofstream(facts.file("hidraw3/device/uevent")) << "HID_NAME=Wheel\n";
  const auto descriptor = mock.wheel.descriptor();
  std::ofstream(facts.file("hidraw3/device/report_descriptor"), std::ios::binary)
      .write(reinterpret_cast<const char*>(descriptor.data()),
             static_cast<std::streamsize>(descriptor.size()));
  EvdevSettings settings;
  settings.event = "/dev/hidraw3";
  settings.axes = 1;
  settings.scale = {0.25, 15, 2000};
  settings.max_stiffness = 1500;
  EvdevExchange exchange;
  EvdevDevice device(exchange, evdev_limits(settings));
  nanoseconds now = milliseconds(1);
  const auto pass = [&](EvdevLoop& loop, int steps) {
    for (int i = 0; i < steps; ++i) {
      now += milliseconds(1);
      mock.wheel.run_until(now);
      SpringModel model;
      model.wall(0, WallSide::below) = {-0.02, 700, 10};
      device.state(model, now);
      loop.step(std::chrono::microseconds(0));
    }
  };
  {
    EvdevLoop loop(exchange, settings,
                   with_hid_devices(kernel_event_calls("/dev/input"),
                                    kernel_hid_calls("/dev", facts.file("."))),
                   [&now] { return now; });
    pass(loop, 50);
    ASSERT_THAT(loop.take_notices(), Contains(HasSubstr("Wheel: ready")));
    mock.wheel.want(0, -0.03);
    pass(loop, 1500);
    EXPECT_NEAR(mock.wheel.force(0), 300 * 0.01 * 700 / 1000, 0.02);
    EXPECT_EQ(mock.wheel.playing(), 2U);
    EXPECT_EQ(mock.wheel.strange(), 0);
    ASSERT_TRUE(device.read(now).ok);
    EXPECT_NEAR(device.read(now).position.x(), -0.023, 1e-4);
  }
  EXPECT_EQ(mock.wheel.effects(), 0U);
  EvdevLoop loop(
      exchange, settings,
      with_hid_devices(kernel_event_calls("/dev/input"), kernel_hid_calls("/dev", facts.file("."))),
      [&now] { return now; });
  pass(loop, 50);
  static_cast<void>(loop.take_notices());
  mock.is_gone = true;
  pass(loop, 2);
  EXPECT_THAT(loop.take_notices(), Contains(HasSubstr("was unplugged")));
}

}  // namespace
}  // namespace reckon::haptics
