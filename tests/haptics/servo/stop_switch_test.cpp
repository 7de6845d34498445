// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/stop_switch.hpp"

#include <gtest/gtest.h>

namespace reckon::haptics {
namespace {

using namespace std::chrono_literals;

// Polls of a servo, one per millisecond.
class Looks {
 public:
  explicit Looks(std::optional<int> button, ForceStop* shared = nullptr)
      : switch_(shared, button) {}

  bool look(std::uint32_t buttons, bool ok = true) {
    DeviceSample sample;
    sample.ok = ok;
    sample.buttons = buttons;
    now_ += 1ms;
    return switch_.look(sample, now_);
  }
  bool look_for(std::chrono::milliseconds time, std::uint32_t buttons) {
    bool last = false;
    for (auto passed = 0ms; passed < time; passed += 1ms) last = look(buttons);
    return last;
  }

 private:
  StopSwitch switch_;
  std::chrono::nanoseconds now_ = 5s;
};

TEST(StopSwitch, StopsInTheStepOfTheButton) {
  Looks servo(2);
  EXPECT_FALSE(servo.look_for(100ms, 0));
  EXPECT_FALSE(servo.look_for(100ms, 0b1011)) << "another button";
  EXPECT_TRUE(servo.look(0b0100));
  EXPECT_TRUE(servo.look_for(300ms, 0b0100)) << "held down";
  EXPECT_TRUE(servo.look_for(1s, 0)) << "let go";
  (void)servo.look(0b0100);
  EXPECT_FALSE(servo.look(0b0100)) << "pressed again";
  EXPECT_FALSE(servo.look_for(1s, 0));
}

TEST(StopSwitch, BouncingButtonIsPressedOnce) {
  Looks servo(0);
  (void)servo.look_for(100ms, 0);
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(servo.look(1)) << i;
    EXPECT_TRUE(servo.look_for(std::chrono::milliseconds(1 + i % 7), 0)) << i;
  }
  EXPECT_TRUE(servo.look_for(2s, 1)) << "held for long, and let go with bounces";
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(servo.look_for(3ms, 0)) << i;
    EXPECT_TRUE(servo.look(1)) << i;
  }
  EXPECT_TRUE(servo.look_for(100ms, 0));
}

TEST(StopSwitch, TwoQuickPressesStop) {
  Looks servo(0);
  (void)servo.look_for(100ms, 0);
  EXPECT_TRUE(servo.look_for(60ms, 1));
  EXPECT_TRUE(servo.look_for(60ms, 0));
  EXPECT_TRUE(servo.look_for(60ms, 1)) << "0.12 s later";
  EXPECT_TRUE(servo.look_for(1s, 0));
}

TEST(StopSwitch, TwoSimultaneousPressesStop) {
  ForceStop stop;
  Looks left(0, &stop), right(0, &stop);
  for (int i = 0; i < 100; ++i) (void)left.look(0), (void)right.look(0);
  EXPECT_TRUE(left.look(1));
  EXPECT_TRUE(right.look(1));
  EXPECT_TRUE(left.look(1));
  EXPECT_EQ(stop.state().presses, 1U);
  EXPECT_TRUE(stop.is_pressed());
}

TEST(StopSwitch, ButtonHeldAtTheStartStops) {
  Looks servo(3);
  EXPECT_TRUE(servo.look(0b1000));
}

TEST(StopSwitch, FailedReadingIsNoButtonState) {
  Looks servo(0);
  (void)servo.look_for(100ms, 0);
  EXPECT_FALSE(servo.look(1, false));
  EXPECT_TRUE(servo.look(1));
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(servo.look(0, false)) << "unplugged, and stopped";
}

TEST(StopSwitch, DetectsAPressReleasedBetweenTwoSteps) {
  ForceStop stop;
  Looks servo(std::nullopt, &stop);
  EXPECT_FALSE(servo.look(1));
  stop.press(StopCause::program);
  stop.release(StopCause::program);
  EXPECT_TRUE(servo.look(1));
  EXPECT_FALSE(servo.look(1));
}

}  // namespace
}  // namespace reckon::haptics
