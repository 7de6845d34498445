// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The calls themselves, as a program makes them of the kernel: a device of umockdev answers. Its
// parts are looked at by their octets, as the kernel would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <umockdev.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_loop.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* kNode = "/dev/input/event7";
constexpr const char* kDescription =
    "P: /devices/wheel/input/input7/event7\nN: input/event7\nE: DEVNAME=/dev/input/event7\n"
    "E: SUBSYSTEM=input\nE: MAJOR=13\nE: MINOR=71\n\n";

struct Unref {
  template <class T>
  void operator()(T* object) const {
    g_object_unref(object);
  }
};

/// What came over the calls.
class Wheel {
 public:
  Wheel() : bed_(umockdev_testbed_new()), base_(umockdev_ioctl_base_new()) {
    g_signal_connect(base_.get(), "handle-ioctl", G_CALLBACK(on_ioctl), this);
    g_signal_connect(base_.get(), "handle-read", G_CALLBACK(on_read), this);
    g_signal_connect(base_.get(), "handle-write", G_CALLBACK(on_write), this);
    EXPECT_TRUE(umockdev_testbed_add_from_string(bed_.get(), kDescription, nullptr));
    EXPECT_TRUE(umockdev_testbed_attach_ioctl(bed_.get(), kNode, base_.get(), nullptr));
  }
  ~Wheel() { umockdev_testbed_detach_ioctl(bed_.get(), kNode, nullptr); }

  bool is_gone = false;
  std::vector<ff_effect> uploads;
  std::vector<input_event> written;
  std::vector<std::uint64_t> erased;
  std::vector<input_event> to_read;
  int grabs = 0;

 private:
  struct Answer {
    long result = 0;
    int error = 0;
  };

  // Sign-extended by umockdev where its top bit is set.
  static std::uint32_t request_of(UMockdevIoctlClient* client) {
    return static_cast<std::uint32_t>(umockdev_ioctl_client_get_request(client));
  }
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    const Answer answer = static_cast<Wheel*>(self)->answer(client);
    umockdev_ioctl_client_complete(client, answer.result, answer.error);
    return TRUE;
  }
  static gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto& wheel = *static_cast<Wheel*>(self);
    UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
    input_event event{};
    std::memcpy(&event, data->data, std::min<std::size_t>(sizeof event, data->data_len));
    wheel.written.push_back(event);
    umockdev_ioctl_client_complete(client, wheel.is_gone ? -1 : data->data_len,
                                   wheel.is_gone ? ENODEV : 0);
    return TRUE;
  }
  static gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto& wheel = *static_cast<Wheel*>(self);
    if (wheel.is_gone || wheel.to_read.empty()) {
      umockdev_ioctl_client_complete(client, -1, wheel.is_gone ? ENODEV : EAGAIN);
      return TRUE;
    }
    const auto octets = static_cast<int>(wheel.to_read.size() * sizeof(input_event));
    UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
    umockdev_ioctl_data_update(data, 0, reinterpret_cast<guint8*>(wheel.to_read.data()), octets);
    wheel.to_read.clear();
    umockdev_ioctl_client_complete(client, octets, 0);
    return TRUE;
  }

  template <class T>
  static UMockdevIoctlData* argument(UMockdevIoctlClient* client, T& into) {
    UMockdevIoctlData* const data =
        umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof into, nullptr);
    std::memcpy(&into, data->data, sizeof into);
    return data;
  }
  template <class T>
  static void give(UMockdevIoctlClient* client, T value) {
    T old;
    UMockdevIoctlData* const data = argument(client, old);
    umockdev_ioctl_data_update(data, 0, reinterpret_cast<guint8*>(&value), sizeof value);
  }
  static void give_octets(UMockdevIoctlClient* client, std::vector<guint8> octets,
                          std::size_t room) {
    octets.resize(room);
    UMockdevIoctlData* const data = umockdev_ioctl_data_resolve(
        umockdev_ioctl_client_get_arg(client), 0, static_cast<int>(room), nullptr);
    umockdev_ioctl_data_update(data, 0, octets.data(), static_cast<int>(room));
  }
  static std::uint64_t value_of(UMockdevIoctlClient* client) {
    UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
    std::uint64_t value = 0;
    std::memcpy(&value, data->data, sizeof value);
    return value;
  }

  Answer answer(UMockdevIoctlClient* client) {
    const std::uint32_t request = request_of(client);
    if (is_gone) return {-1, ENODEV};
    const std::uint32_t size = _IOC_SIZE(request);
    const auto is = [&](unsigned long whole) {
      return (request & ~std::uint32_t{IOCSIZE_MASK}) ==
             (static_cast<std::uint32_t>(whole) & ~std::uint32_t{IOCSIZE_MASK});
    };
    const auto bits = [&](std::initializer_list<std::size_t> which) {
      std::vector<guint8> octets(size);
      for (const std::size_t bit : which) octets[bit / 8] |= static_cast<guint8>(1U << bit % 8);
      give_octets(client, octets, size);
      return Answer{static_cast<long>(size), 0};
    };
    if (is(EVIOCGBIT(EV_FF, 0))) return bits({FF_SPRING, FF_GAIN, FF_AUTOCENTER});
    if (is(EVIOCGBIT(EV_ABS, 0))) return bits({ABS_X, ABS_Y});
    if (is(EVIOCGBIT(EV_KEY, 0))) return bits({BTN_TRIGGER, BTN_THUMB});
    if (is(EVIOCGKEY(0))) return bits({BTN_THUMB});
    if (is(EVIOCGNAME(0))) {
      give_octets(client, {'W', 'h', 'e', 'e', 'l'}, size);
      return {6, 0};
    }
    if (is(EVIOCGEFFECTS)) {
      give(client, 8);
    } else if (is(EVIOCGABS(ABS_X)) || is(EVIOCGABS(ABS_Y))) {
      input_absinfo info{};
      info.value = is(EVIOCGABS(ABS_X)) ? 750 : 250;
      info.maximum = 1000;
      give(client, info);
    } else if (is(EVIOCGRAB)) {
      ++grabs;
    } else if (is(EVIOCSFF)) {
      ff_effect effect{};
      argument(client, effect);
      if (effect.id < 0) effect.id = static_cast<std::int16_t>(uploads.size() + 3);
      uploads.push_back(effect);
      give(client, effect);
    } else if (is(EVIOCRMFF)) {
      erased.push_back(value_of(client));
    } else {
      return {-1, ENOTTY};
    }
    return {0, 0};
  }

  std::unique_ptr<UMockdevTestbed, Unref> bed_;
  std::unique_ptr<UMockdevIoctlBase, Unref> base_;
};

TEST(EvdevKernel, TheCallsCarryTheRightNumbers) {
  if (std::getenv("LD_PRELOAD") == nullptr) GTEST_SKIP() << "runs under umockdev-wrapper alone";
  Wheel wheel;
  EvdevSettings settings;
  settings.event = kNode;
  settings.scale = {0.2, 20, 2000};
  settings.max_stiffness = 1500;
  EvdevExchange exchange;
  EvdevDevice device(exchange, evdev_limits(settings));
  nanoseconds now{0};
  {
    EvdevLoop loop(exchange, settings, kernel_event_calls(), [&now] { return now; });
    loop.step(milliseconds(0));
    ASSERT_THAT(loop.take_notices(), Contains(HasSubstr("Wheel: ready")));
    EXPECT_EQ(wheel.grabs, 1);
    ASSERT_EQ(wheel.uploads.size(), 2U);
    EXPECT_EQ(wheel.uploads[0].type, FF_SPRING);
    EXPECT_EQ(wheel.uploads[0].replay.length, 60);
    const auto wrote = [&](std::size_t i, int code, int value) {
      return wheel.written.at(i).type == EV_FF && wheel.written[i].code == code &&
             wheel.written[i].value == value;
    };
    ASSERT_EQ(wheel.written.size(), 4U);
    EXPECT_TRUE(wrote(0, FF_AUTOCENTER, 0));
    EXPECT_TRUE(wrote(1, FF_GAIN, 0xFFFF));
    EXPECT_TRUE(wrote(2, 3, 1));
    EXPECT_TRUE(wrote(3, 4, 1));

    DeviceSample sample = device.read(now);
    ASSERT_TRUE(sample.ok);
    EXPECT_NEAR(sample.position.x(), 0.05, 1e-12);
    EXPECT_NEAR(sample.position.y(), -0.05, 1e-12);
    EXPECT_EQ(sample.buttons, 2U);

    const auto event = [](int type, int code, int value) {
      input_event out{};
      out.type = static_cast<std::uint16_t>(type);
      out.code = static_cast<std::uint16_t>(code);
      out.value = value;
      return out;
    };
    wheel.to_read = {event(EV_ABS, ABS_X, 500), event(EV_KEY, BTN_THUMB, 0),
                     event(EV_SYN, SYN_REPORT, 0)};
    SpringModel model;
    model.wall(0, WallSide::below) = {-0.05, 1000, 10};
    now = milliseconds(25);  // it has what it was told at first
    device.state(model, now);
    loop.step(milliseconds(0));
    sample = device.read(now);
    EXPECT_NEAR(sample.position.x(), 0, 1e-12);
    EXPECT_EQ(sample.buttons, 0U);
    ASSERT_EQ(wheel.uploads.size(), 3U);
    EXPECT_EQ(wheel.uploads[2].id, 3);  // in place
    EXPECT_EQ(wheel.uploads[2].u.condition[0].center, -16384);
    EXPECT_EQ(wheel.uploads[2].u.condition[0].left_coeff, 16383);
    EXPECT_EQ(wheel.uploads[2].u.condition[0].left_saturation, 32767);
    EXPECT_EQ(wheel.uploads[2].u.condition[0].right_coeff, 0);

    wheel.is_gone = true;
    loop.step(milliseconds(0));
    EXPECT_THAT(loop.take_notices(), Contains(HasSubstr("was unplugged")));
    EXPECT_FALSE(device.read(now).ok);
    wheel.is_gone = false;
    now = milliseconds(600);
    loop.step(milliseconds(0));
    EXPECT_THAT(loop.take_notices(), Contains(HasSubstr("ready")));
  }
  // The end of the program takes the effects off.
  ASSERT_EQ(wheel.erased.size(), 2U);
  EXPECT_EQ(wheel.written.back().value, 0);
}

}  // namespace
}  // namespace reckon::haptics
