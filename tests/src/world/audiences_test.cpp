// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sent state of each audience of an entity.
#include "reckon/peer/world/audiences.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "reckon/tests/src/support/poses.hpp"

namespace reckon::peer::audiences_test {
namespace {

using deadreckon::SendReason;
using test::at;
using test::last_sent_at;

constexpr double kThreshold = 0.1;  // [m]

std::vector<aoim::Channel> rows() {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  return {{20.0, aoim::Body::full, 30.0, 1.0, 144.0, false, 1.0},
          {60.0, aoim::Body::approximate, 10.0, 1.0, 144.0, false, 2.0},
          {kForever, aoim::Body::rigid, 1.0, 1.0, 144.0, false, 8.0}};
}

Audiences made(std::size_t urgent, const std::vector<aoim::Channel>& table = rows()) {
  deadreckon::Thresholds thresholds;
  thresholds.position = kThreshold;
  return {urgent, table, deadreckon::UpdatePolicy(thresholds, 5.0, 0.2),
          deadreckon::kDefaultSendRule, 1.0};
}

TEST(Audiences, AreOnePerRowPlusTheTouchTier) {
  EXPECT_EQ(made(0).last(), 2u);
  EXPECT_EQ(made(1).last(), 3u);
  EXPECT_EQ(made(1, {}).last(), 1u) << "all, and those who touch";
  EXPECT_EQ(made(1).row_of(1), 0u);
  EXPECT_EQ(made(1).audience_of(2), 3u);
  EXPECT_EQ(made(0).row_of(2), 2u);
  EXPECT_EQ(made(0).receive_parts(), 1u) << "a rigid body has none";
  EXPECT_EQ(made(1).receive_parts(), 2u);
}

TEST(Audiences, SendByTheirOwnCopyAndThreshold) {
  Audiences all = made(0);
  all.note_sent(all.last(), last_sent_at(0.0), 1.0, SendReason::first, true);
  all.note_sent(0, last_sent_at(0.15), 1.1, SendReason::position, true);
  EXPECT_EQ(all.decide(1, at(0.19), 1.1), SendReason::none) << "twice as wide";
  EXPECT_EQ(all.decide(1, at(0.21), 1.1), SendReason::position);
  EXPECT_EQ(all.decide(2, at(0.21), 1.1), SendReason::none);
  EXPECT_EQ(all.decide(2, at(0.81), 1.1), SendReason::position);
  all.note_sent(1, last_sent_at(0.21), 1.1, SendReason::position, true);
  EXPECT_EQ(all.decide(1, at(0.3), 1.2), SendReason::none);
  EXPECT_EQ(all.decide(2, at(0.81), 1.2), SendReason::position) << "that was not for them";
}

TEST(Audiences, AreBehindUntilAFullUpdate) {
  Audiences all = made(0);
  all.note_sent(all.last(), last_sent_at(0.0), 1.0, SendReason::first, true);
  EXPECT_FALSE(all.is_behind(1) || all.is_behind(2));
  all.note_sent(1, last_sent_at(0.1), 1.1, SendReason::position, true);
  EXPECT_FALSE(all.is_behind(1));
  EXPECT_TRUE(all.is_behind(2));
  all.note_sent(2, last_sent_at(0.2), 1.2, SendReason::position, false);
  EXPECT_TRUE(all.is_behind(2)) << "its parts are not theirs to know";
  all.note_sent(2, last_sent_at(0.2), 1.3, SendReason::event, true);
  EXPECT_FALSE(all.is_behind(2));
}

TEST(Audiences, AreSynchronisedOnceWithoutInnerListeners) {
  Audiences all = made(0);
  all.note_sent(all.last(), last_sent_at(0.0), 1.0, SendReason::first, true);
  all.note_sent(0, last_sent_at(0.1), 2.0, SendReason::position, true);
  EXPECT_FALSE(all.is_out_of_step(1, 2.0, 9.0)) << "somebody may listen to the nearest row";
  all.serve(2, {});
  EXPECT_FALSE(all.is_out_of_step(1, 2.0, 2.5)) << "nor is who was near gone at once";
  EXPECT_TRUE(all.is_out_of_step(1, 2.0, 3.0));
  EXPECT_TRUE(all.is_out_of_step(2, 1.0, 3.0));
  all.note_sent(2, last_sent_at(0.1), 3.0, SendReason::heartbeat, true);
  EXPECT_FALSE(all.is_out_of_step(2, 3.0, 9.0));
}

TEST(Audiences, HaveLongerHeartbeatsTheCoarserTheyAre) {
  Audiences all = made(0);
  all.note_sent(all.last(), last_sent_at(0.0), 1.0, SendReason::position, true);
  EXPECT_DOUBLE_EQ(all.next(1), 3.0) << "1 s, twice as long";
  EXPECT_DOUBLE_EQ(all.next(2), 6.0) << "eight times, a heartbeat at most";
  EXPECT_EQ(all.decide(1, at(0.0), 3.0), SendReason::heartbeat);
}

// Contact groups, as without rows.
TEST(Audiences, FollowTheTouchTierWithinHalfASecond) {
  Audiences all = made(1);
  all.note_sent(all.last(), last_sent_at(0.0), 1.0, SendReason::first, true);
  all.note_sent(0, last_sent_at(0.0), 1.1, SendReason::force, true);
  EXPECT_DOUBLE_EQ(all.next(1), 1.5);
  EXPECT_EQ(all.decide(1, at(0.0), 1.5), SendReason::heartbeat);
  EXPECT_EQ(all.decide(2, at(0.0), 1.5), SendReason::none) << "who leaves a row goes back";
}

}  // namespace
}  // namespace reckon::peer::audiences_test
