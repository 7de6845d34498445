// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/playback.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;

deadreckon::KinematicState at(double x, double speed) {
  deadreckon::KinematicState state;
  state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  state.position.x() = x;
  state.velocity.x() = speed;
  return state;
}

TEST(Playback, ShowsTheStateOfItsTime) {
  Playback playback;
  playback.receive(at(0, 1), milliseconds(1000));      // flies
  playback.receive(at(0.01, 0), milliseconds(1010));   // is stopped
  playback.receive(at(0.01, -1), milliseconds(1100));  // moves back
  const auto shown = [&](int now) { return playback.pose(milliseconds(now), 0.1).position.x(); };
  EXPECT_NEAR(shown(1105), 0.005, 1e-12);
  EXPECT_NEAR(shown(1150), 0.01, 1e-12);
  EXPECT_NEAR(shown(1199), 0.01, 1e-12);
  EXPECT_NEAR(shown(1205), 0.005, 1e-12);
  EXPECT_NEAR(shown(1050), -0.05, 1e-12) << "before the first";
}

TEST(Playback, StopsAtALaterKnownStop) {
  Playback playback;
  playback.receive(at(0, 1), milliseconds(1000));     // flies
  playback.receive(at(0.01, 0), milliseconds(1040));  // was stopped; that update was lost
  const auto shown = [&](int now) { return playback.pose(milliseconds(now), 0.1).position.x(); };
  EXPECT_NEAR(shown(1120), 0.005, 1e-12);
  EXPECT_NEAR(shown(1139), 0.00975, 1e-12);
  EXPECT_NEAR(shown(1150), 0.01, 1e-12);
}

TEST(Playback, LagsOnlyAfterALateBlow) {
  Playback playback;
  playback.begin(0.005);
  EXPECT_EQ(playback.behind(), 0.0);
  playback.begin(0.1);
  EXPECT_NEAR(playback.behind(), 0.132, 1e-12);
  playback.begin(0.05);
  EXPECT_NEAR(playback.behind(), 0.132, 1e-12) << "a second one in it";
  playback.begin(10);
  EXPECT_NEAR(playback.behind(), 0.3, 1e-12) << "never farther";
  playback.catch_up(0.2);
  EXPECT_NEAR(playback.behind(), 0.1, 1e-12);
  playback.catch_up(0.2);
  EXPECT_EQ(playback.behind(), 0.0);
}

TEST(Playback, BlowIsQuickOrLate) {
  EXPECT_TRUE(Playback::is_blow(0.2, 0.0));
  EXPECT_FALSE(Playback::is_blow(0.1, 0.0003));
  EXPECT_TRUE(Playback::is_blow(0.1, 0.2));
  EXPECT_FALSE(Playback::is_blow(0.02, 1.0));
  EXPECT_FALSE(Playback::is_blow(-1.0, 0.2));
  EXPECT_FALSE(Playback::is_blow(std::numeric_limits<double>::quiet_NaN(), 0.2));
}

TEST(Playback, KeepsTheNewestAndForgetsAResetClock) {
  Playback playback;
  for (int i = 0; i < 100; ++i) playback.receive(at(i, 0), milliseconds(1000 + i));
  EXPECT_EQ(playback.pose(milliseconds(1090), 0.01).position.x(), 80.0);
  EXPECT_EQ(playback.pose(milliseconds(1020), 0.01).position.x(), 68.0)
      << "the oldest that is kept";
  playback.receive(at(-1, 0), milliseconds(500));
  EXPECT_EQ(playback.pose(milliseconds(1090), 0.01).position.x(), -1.0);
}

TEST(HandPose, StopsBeforeAnOldAccelerationReversesIt) {
  deadreckon::KinematicState state = at(0, -0.3);
  state.algorithm = pdu::DeadReckoningAlgorithm::fvw;
  state.acceleration.x() = 5;
  EXPECT_EQ(hand_pose(state, 0.05).position, deadreckon::extrapolate(state, 0.05).position);
  const double there = deadreckon::extrapolate(state, 0.07).position.x();
  EXPECT_EQ(hand_pose(state, 1.0).position.x(), there);
  state.velocity.x() = -0.5;  // slower then, and still in that direction
  EXPECT_LT(hand_pose(state, 1.0).position.x(), -0.1);
}

}  // namespace
}  // namespace reckon::haptics
