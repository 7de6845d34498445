// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The calls themselves, as a program makes them to the kernel; a device of umockdev answers. Its
// parts are checked by their octets, as the kernel reads them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/input.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <span>
#include <vector>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/tests/haptics/support/mocked_node.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Data received by the calls.
class Wheel : public test::MockedNode {
 public:
  Wheel() : MockedNode("input/event7", "input", "/devices/wheel/input/input7/event7") {}

  bool is_gone = false;
  std::vector<ff_effect> uploads;
  std::vector<input_event> written;
  std::vector<std::uint64_t> erased;
  std::vector<input_event> to_read;
  int grabs = 0;

 private:
  long write(std::span<const std::uint8_t> octets) override {
    input_event event{};
    std::memcpy(&event, octets.data(), std::min(sizeof event, octets.size()));
    written.push_back(event);
    return is_gone ? -ENODEV : static_cast<long>(octets.size());
  }
  long read(Octets& octets) override {
    if (is_gone || to_read.empty()) return is_gone ? -ENODEV : -EAGAIN;
    const auto bytes = std::as_bytes(std::span(to_read));
    octets.resize(bytes.size());
    std::memcpy(octets.data(), bytes.data(), bytes.size());
    to_read.clear();
    return static_cast<long>(octets.size());
  }

  template <class T>
  static long give(const Request& request, const T& value) {
    Octets octets(sizeof value);
    std::memcpy(octets.data(), &value, sizeof value);
    request.give(octets);
    return 0;
  }
  long control(const Request& request) override {
    if (is_gone) return -ENODEV;
    const auto is = [&](unsigned long whole) { return request.is(whole); };
    const auto bits = [&](std::initializer_list<std::size_t> which) {
      Octets octets(request.size());
      for (const std::size_t bit : which)
        octets[bit / 8] |= static_cast<std::uint8_t>(1U << bit % 8);
      return request.give(octets);
    };
    if (is(EVIOCGBIT(EV_FF, 0))) return bits({FF_SPRING, FF_GAIN, FF_AUTOCENTER});
    if (is(EVIOCGBIT(EV_ABS, 0))) return bits({ABS_X, ABS_Y});
    if (is(EVIOCGBIT(EV_KEY, 0))) return bits({BTN_TRIGGER, BTN_THUMB});
    if (is(EVIOCGKEY(0))) return bits({BTN_THUMB});
    if (is(EVIOCGNAME(0))) return request.give(Octets{'W', 'h', 'e', 'e', 'l', 0});
    if (is(EVIOCGEFFECTS)) return give(request, 8);
    if (is(EVIOCGABS(ABS_X)) || is(EVIOCGABS(ABS_Y))) {
      input_absinfo info{};
      info.value = is(EVIOCGABS(ABS_X)) ? 750 : 250;
      info.maximum = 1000;
      return give(request, info);
    }
    if (is(EVIOCSFF)) {
      ff_effect effect{};
      std::memcpy(&effect, request.octets().data(), sizeof effect);
      if (effect.id < 0) effect.id = static_cast<std::int16_t>(uploads.size() + 3);
      uploads.push_back(effect);
      return give(request, effect);
    }
    if (is(EVIOCGRAB)) {
      ++grabs;
    } else if (is(EVIOCRMFF)) {
      erased.push_back(request.value());
    } else {
      return -ENOTTY;
    }
    return 0;
  }
};

/// Grabbed, with two springs uploaded and running, at full gain and without autocentre.
void expect_taken_over(const Wheel& wheel) {
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
}

input_event event(int type, int code, int value) {
  input_event out{};
  out.type = static_cast<std::uint16_t>(type);
  out.code = static_cast<std::uint16_t>(code);
  out.value = value;
  return out;
}

TEST(EvdevKernel, CallsCarryTheRightNumbers) {
  if (std::getenv("LD_PRELOAD") == nullptr) GTEST_SKIP() << "runs under umockdev-wrapper alone";
  Wheel wheel;
  EvdevSettings settings;
  settings.event = "/dev/input/event7";
  settings.scale = {0.2, 20, 2000};
  settings.max_stiffness = 1500;
  EvdevExchange exchange;
  EvdevDevice device(exchange, evdev_limits(settings));
  nanoseconds now{0};
  {
    EvdevLoop loop(exchange, settings, kernel_event_calls(), [&now] { return now; });
    loop.step(milliseconds(0));
    ASSERT_THAT(loop.take_notices(), Contains(HasSubstr("Wheel: ready")));
    ASSERT_NO_FATAL_FAILURE(expect_taken_over(wheel));

    DeviceSample sample = device.read(now);
    ASSERT_TRUE(sample.ok);
    EXPECT_NEAR(sample.position.x(), 0.05, 1e-12);
    EXPECT_NEAR(sample.position.y(), -0.05, 1e-12);
    EXPECT_EQ(sample.buttons, 2U);

    wheel.to_read = {event(EV_ABS, ABS_X, 500), event(EV_KEY, BTN_THUMB, 0),
                     event(EV_SYN, SYN_REPORT, 0)};
    SpringModel model;
    model.wall(0, WallSide::below) = {-0.05, 1000, 10};
    now = milliseconds(25);  // the initial uploads are done
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
  // The end of the program removes the effects.
  ASSERT_EQ(wheel.erased.size(), 2U);
  EXPECT_EQ(wheel.written.back().value, 0);
}

}  // namespace
}  // namespace reckon::haptics
