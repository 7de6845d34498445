// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The calls themselves, as a program makes them of the kernel: a wheel behind a device of umockdev
// answers them by the octets that the kernel would hand on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <umockdev.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/hid/hid_events.hpp"
#include "reckon/tests/haptics/support/pid_wheel.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* kNode = "/dev/hidraw3";
constexpr const char* kDescription =
    "P: /devices/wheel/hidraw/hidraw3\nN: hidraw3\nE: DEVNAME=/dev/hidraw3\n"
    "E: SUBSYSTEM=hidraw\nE: MAJOR=240\nE: MINOR=3\n\n";

struct Unref {
  template <class T>
  void operator()(T* object) const {
    g_object_unref(object);
  }
};

/// A PidWheel, asked by another thread.
class MockedWheel {
 public:
  MockedWheel() : bed_(umockdev_testbed_new()), base_(umockdev_ioctl_base_new()) {
    g_signal_connect(base_.get(), "handle-ioctl", G_CALLBACK(on_ioctl), this);
    g_signal_connect(base_.get(), "handle-read", G_CALLBACK(on_read), this);
    g_signal_connect(base_.get(), "handle-write", G_CALLBACK(on_write), this);
    EXPECT_TRUE(umockdev_testbed_add_from_string(bed_.get(), kDescription, nullptr));
    EXPECT_TRUE(umockdev_testbed_attach_ioctl(bed_.get(), kNode, base_.get(), nullptr));
  }
  ~MockedWheel() { umockdev_testbed_detach_ioctl(bed_.get(), kNode, nullptr); }

  template <class Use>
  auto with(Use&& use) {
    const std::lock_guard lock(mutex_);
    return use(wheel_);
  }
  void unplug() {
    const std::lock_guard lock(mutex_);
    is_gone_ = true;
  }

 private:
  using Octets = std::vector<std::uint8_t>;

  static void complete(UMockdevIoctlClient* client, long result) {
    umockdev_ioctl_client_complete(client, result < 0 ? -1 : result,
                                   result < 0 ? static_cast<int>(-result) : 0);
  }
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    complete(client, static_cast<MockedWheel*>(self)->answer(client));
    return TRUE;
  }
  static gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto& mock = *static_cast<MockedWheel*>(self);
    const std::lock_guard lock(mock.mutex_);
    const UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
    const Octets report(data->data, data->data + data->data_len);
    if (!mock.is_gone_) mock.wheel_.take(report);
    complete(client, mock.is_gone_ ? -ENODEV : static_cast<long>(report.size()));
    return TRUE;
  }
  static gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto& mock = *static_cast<MockedWheel*>(self);
    const std::lock_guard lock(mock.mutex_);
    Octets report = mock.wheel_.input();
    if (mock.is_gone_ || report == mock.sent_) {
      complete(client, mock.is_gone_ ? -EIO : -EAGAIN);
      return TRUE;
    }
    mock.sent_ = report;
    umockdev_ioctl_data_update(umockdev_ioctl_client_get_arg(client), 0, report.data(),
                               static_cast<int>(report.size()));
    complete(client, static_cast<long>(report.size()));
    return TRUE;
  }

  long answer(UMockdevIoctlClient* client) {
    const std::lock_guard lock(mutex_);
    if (is_gone_) return -ENODEV;
    // Sign-extended by umockdev where its top bit is set.
    const auto request = static_cast<std::uint32_t>(umockdev_ioctl_client_get_request(client));
    const std::uint32_t size = _IOC_SIZE(request);
    const auto is = [&](unsigned long whole) {
      return (request & ~std::uint32_t{IOCSIZE_MASK}) ==
             (static_cast<std::uint32_t>(whole) & ~std::uint32_t{IOCSIZE_MASK});
    };
    UMockdevIoctlData* const data = umockdev_ioctl_data_resolve(
        umockdev_ioctl_client_get_arg(client), 0, static_cast<int>(size), nullptr);
    const auto give = [&](Octets octets) -> long {
      octets.resize(std::min<std::size_t>(octets.size(), size));
      umockdev_ioctl_data_update(data, 0, octets.data(), static_cast<int>(octets.size()));
      return static_cast<long>(octets.size());
    };
    if (is(HIDIOCGRAWINFO)) return 0;
    if (is(HIDIOCGINPUT(0))) return give(wheel_.input());
    if (is(HIDIOCGFEATURE(0))) {
      const auto report = wheel_.feature(data->data[0]);
      return report ? give(*report) : -EPIPE;
    }
    if (!is(HIDIOCSFEATURE(0))) return -ENOTTY;
    wheel_.take(Octets(data->data, data->data + size));
    return static_cast<long>(size);
  }

  std::mutex mutex_;
  test::PidWheel wheel_{{}};
  Octets sent_;
  bool is_gone_ = false;
  std::unique_ptr<UMockdevTestbed, Unref> bed_;
  std::unique_ptr<UMockdevIoctlBase, Unref> base_;
};

TEST(HidKernel, TheCallsCarryTheReports) {
  if (std::getenv("LD_PRELOAD") == nullptr) GTEST_SKIP() << "runs under umockdev-wrapper alone";
  MockedWheel mock;
  const test::ScratchFolder facts;
  std::filesystem::create_directories(facts.file("hidraw3/device"));
  std::ofstream(facts.file("hidraw3/device/uevent")) << "HID_NAME=Wheel\n";
  const auto descriptor = mock.with([](test::PidWheel& wheel) { return wheel.descriptor(); });
  std::ofstream(facts.file("hidraw3/device/report_descriptor"), std::ios::binary)
      .write(reinterpret_cast<const char*>(descriptor.data()),
             static_cast<std::streamsize>(descriptor.size()));
  EvdevSettings settings;
  settings.event = kNode;
  settings.axes = 1;
  settings.scale = {0.25, 15, 2000};
  settings.max_stiffness = 1500;
  EvdevExchange exchange;
  EvdevDevice device(exchange, evdev_limits(settings));
  nanoseconds now = milliseconds(1);
  const auto pass = [&](EvdevLoop& loop, int steps) {
    for (int i = 0; i < steps; ++i) {
      now += milliseconds(1);
      mock.with([&](test::PidWheel& wheel) { wheel.run_until(now); });
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
    mock.with([](test::PidWheel& wheel) { wheel.want(0, -0.03); });
    pass(loop, 1500);
    mock.with([](test::PidWheel& wheel) {
      EXPECT_NEAR(wheel.force(0), 300 * 0.01 * 700 / 1000, 0.02);
      EXPECT_EQ(wheel.playing(), 2U);
      EXPECT_EQ(wheel.strange(), 0);
    });
    ASSERT_TRUE(device.read(now).ok);
    EXPECT_NEAR(device.read(now).position.x(), -0.023, 1e-4);
  }
  mock.with([](test::PidWheel& wheel) { EXPECT_EQ(wheel.effects(), 0U); });
  EvdevLoop loop(
      exchange, settings,
      with_hid_devices(kernel_event_calls("/dev/input"), kernel_hid_calls("/dev", facts.file("."))),
      [&now] { return now; });
  pass(loop, 50);
  static_cast<void>(loop.take_notices());
  mock.unplug();
  pass(loop, 2);
  EXPECT_THAT(loop.take_notices(), Contains(HasSubstr("was unplugged")));
}

}  // namespace
}  // namespace reckon::haptics
