// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/seen_side.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/src/support/poses.hpp"

namespace reckon::peer {
namespace {

using deadreckon::SendReason;
using test::at;
using test::last_sent_at;

constexpr double kThreshold = 0.01;  // [m]

// At 1 s all received a state that moves at 1 m/s.
SeenSide told() {
  deadreckon::Thresholds thresholds;
  thresholds.position = kThreshold;
  SeenSide seen(deadreckon::UpdatePolicy(thresholds, 5.0, 1.0));
  seen.note_sent_to_all(last_sent_at(0.0, 1.0), 1.0, SendReason::event);
  return seen;
}

TEST(SeenSide, UsesItsOwnPredictionDespiteInnerUpdates) {
  SeenSide seen = told();
  EXPECT_EQ(seen.decide(at(0.1), 1.1), SendReason::none);
  seen.note_sent_to_inner();
  EXPECT_EQ(seen.decide(at(0.1), 1.1), SendReason::none);
  EXPECT_EQ(seen.decide(at(0.1 + 1.1 * kThreshold), 1.1), SendReason::position);
  seen.event();
  EXPECT_EQ(seen.decide(at(0.1), 1.1), SendReason::event);
}

TEST(SeenSide, FollowsInnerUpdatesWithinHalfASecond) {
  SeenSide seen = told();
  EXPECT_EQ(seen.next(), 2.0) << "its first repetition";
  seen.note_sent_to_inner();
  EXPECT_EQ(seen.next(), 1.0 + SeenSide::kBehind);
  EXPECT_EQ(seen.decide(at(0.49), 1.49), SendReason::none);
  EXPECT_EQ(seen.decide(at(0.5), 1.5), SendReason::heartbeat);
  seen.note_sent_to_all(last_sent_at(0.0, 1.0), 1.5, SendReason::heartbeat);
  EXPECT_EQ(seen.decide(at(1.0), 2.5), SendReason::none) << "nobody knows more than the others";
}

}  // namespace
}  // namespace reckon::peer
