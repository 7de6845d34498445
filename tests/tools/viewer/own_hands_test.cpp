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

// The force of a body that another peer simulates, or that hands of two peers press, depends on the
// network. A body may be between two hands.
TEST(OwnHands, HideTrueForceAtSharedBodies) {
  peer::HandModel model;
  model.radius = 0.01;
  model.k1 = 300;
  OwnHands hands{model};
  hands.add(0, {});
  hands.add(1, {});
  haptics::ServoSnapshot step[2];
  step[1].device.x() = 1;
  const auto known = [&] {
    for (std::size_t i = 0; i < 2; ++i) hands.take(i, step[i]);
    const HandFrame frame = hands.frame(0ns, true);
    return std::pair((frame.hands[0].flags & kHandTrueForce) != 0,
                     (frame.hands[1].flags & kHandTrueForce) != 0);
  };
  EXPECT_EQ(known(), std::pair(true, true));
  step[0].tally.at_bodies = 0.01;
  EXPECT_EQ(known(), std::pair(true, true)) << "a hand presses a body of its peer alone";
  step[0].tally.at_bodies = 0.02;
  step[1].tally.bodies = 0.01;
  EXPECT_EQ(known(), std::pair(false, false)) << "both press a body";
  step[1].tally.bodies = 0.02;
  EXPECT_EQ(known(), std::pair(true, false)) << "a hand presses a body of the other peer";
  step[1].device.x() = 0.015;
  EXPECT_EQ(known(), std::pair(true, true)) << "they press each other";
  step[0].tally.at_bodies = 0.03;
  EXPECT_EQ(known(), std::pair(false, false)) << "a body may be between them";
}

}  // namespace
}  // namespace reckon::tools
