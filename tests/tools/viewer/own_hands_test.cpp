// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/own_hands.hpp"

#include <gtest/gtest.h>

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;

TEST(OwnHands, MarkTheForceOfAHiddenTwin) {
  OwnHands hands{peer::HandModel{}};
  hands.add(0, {});
  hands.add(1, {});
  EXPECT_TRUE(hands.frame(0ns, true).twins.empty());
  EXPECT_EQ(hands.frame(0ns, true).hands[1].flags & kHandTwin, 0);

  hands.set_twin(1, {2.5, -0.25, 3});
  HandFrame frame = hands.frame(0ns, true);
  EXPECT_EQ(frame.hands[0].flags & kHandTwin, 0);
  EXPECT_NE(frame.hands[1].flags & kHandTwin, 0);
  EXPECT_EQ(frame.hands[1].twin_force, 2.5F);
  ASSERT_EQ(frame.twins.size(), 1U);
  EXPECT_EQ(frame.twins[0].hand, 1);
  EXPECT_EQ(frame.twins[0].energy, -0.25);
  EXPECT_EQ(frame.twins[0].resets, 3U);

  hands.set_twin(1, {std::nullopt, 0, 4});  // it is not shown
  frame = hands.frame(0ns, true);
  EXPECT_EQ(frame.hands[1].flags & kHandTwin, 0);
  EXPECT_EQ(frame.twins.size(), 1U);
}

// By the software stop, or by a device that releases: two different causes.
TEST(OwnHands, AreMarkedWhereTheirForceIsStopped) {
  OwnHands hands{peer::HandModel{}};
  hands.add(0, {});
  const auto flags = [&](bool enabled, bool stopped) {
    haptics::ServoSnapshot step;
    step.enabled = enabled;
    step.stopped = stopped;
    hands.take(0, step);
    return hands.frame(0ns, true).hands[0].flags & (kHandStopped | kHandLetGo);
  };
  EXPECT_EQ(flags(true, false), 0);
  EXPECT_EQ(flags(false, true), kHandStopped);
  EXPECT_EQ(flags(false, false), kHandLetGo);
}

}  // namespace
}  // namespace reckon::tools
