// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/event_state.hpp"

#include <gtest/gtest.h>

namespace reckon::haptics {
namespace {

input_event event(std::uint16_t type, std::uint16_t code, std::int32_t value) {
  input_event out{};
  out.type = type;
  out.code = code;
  out.value = value;
  return out;
}
const input_event kReport = event(EV_SYN, SYN_REPORT, 0);

TEST(EventState, IsValidAtTheEndOfAFrame) {
  EventState state;
  state.take(event(EV_ABS, ABS_X, 5));
  state.take(event(EV_ABS, ABS_Y, -7));
  EXPECT_EQ(state.axis(0), 0);
  state.take(kReport);
  EXPECT_EQ(state.axis(0), 5);
  EXPECT_EQ(state.axis(1), -7);
}

TEST(EventState, OtherAxesAndEventsChangeNothing) {
  EventState state;
  state.take(event(EV_ABS, ABS_Z, 5));
  state.take(event(EV_REL, REL_X, 5));
  state.take(event(EV_MSC, MSC_SCAN, 5));
  state.take(kReport);
  EXPECT_EQ(state.axis(0), 0);
  EXPECT_EQ(state.axis(1), 0);
}

TEST(EventState, ButtonsAreNumberedInTheirOrder) {
  EventState state({BTN_TRIGGER, BTN_THUMB});
  state.take(event(EV_KEY, BTN_THUMB, 1));
  state.take(event(EV_KEY, BTN_BASE, 1));
  state.take(kReport);
  EXPECT_EQ(state.buttons(), 2U);
  state.take(event(EV_KEY, BTN_TRIGGER, 1));
  state.take(event(EV_KEY, BTN_THUMB, 0));
  state.take(kReport);
  EXPECT_EQ(state.buttons(), 1U);
}

TEST(EventState, IsInvalidAfterDroppedEventsUntilSet) {
  EventState state;
  state.take(event(EV_ABS, ABS_X, 5));
  state.take(kReport);
  state.take(event(EV_ABS, ABS_X, 6));
  state.take(event(EV_SYN, SYN_DROPPED, 0));
  state.take(event(EV_ABS, ABS_X, 900));
  EXPECT_FALSE(state.wants_all());
  state.take(kReport);
  EXPECT_TRUE(state.wants_all());
  EXPECT_EQ(state.axis(0), 5);
  state.set({42, 43}, 1);
  EXPECT_FALSE(state.wants_all());
  EXPECT_EQ(state.axis(0), 42);
  state.take(event(EV_ABS, ABS_Y, 44));
  state.take(kReport);
  EXPECT_EQ(state.axis(0), 42);
  EXPECT_EQ(state.axis(1), 44);
}

TEST(EventState, MoreThanThirtyTwoButtonsAreIgnored) {
  std::vector<std::uint16_t> codes;
  for (std::uint16_t i = 0; i < 40; ++i) codes.push_back(static_cast<std::uint16_t>(BTN_MISC + i));
  EventState state(codes);
  state.take(event(EV_KEY, BTN_MISC + 31, 1));
  state.take(event(EV_KEY, BTN_MISC + 39, 1));
  state.take(kReport);
  EXPECT_EQ(state.buttons(), 1U << 31);
}

}  // namespace
}  // namespace reckon::haptics
