// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/claims.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr PeerId kOurs{7, 1};

// Claims beside a table with one holder, of number 2 and epoch 22, received since 0 s.
class ClaimsOfOne : public testing::Test {
 protected:
  ClaimsOfOne() {
    Peer holder;
    holder.announced = presence_of(2, 22);
    holder.joined = true;
    peers_.append(holder);
  }

  Claimant& add(std::uint16_t number, std::uint32_t epoch, nanoseconds now) {
    const pdu::Presence announced = presence_of(number, epoch);
    Claimant& claimant = claims_.add({announced, now, now, {}, {}, {}});
    claimant.receive(announced, now, {});
    return claimant;
  }

  PresenceConfig config_;
  PeerTable peers_{8};
  PresenceEvents events_{16};
  Claims claims_{config_, peers_, events_};
};

TEST_F(ClaimsOfOne, RestartIsAcceptedAfterTheHoldersSilence) {
  const nanoseconds since = seconds(10);
  add(2, 33, since);
  EXPECT_EQ(claims_.next_step(kOurs, nanoseconds(0)), since + config_.restart_wait);
  EXPECT_FALSE(claims_.settle(0, kOurs, since + config_.restart_wait - nanoseconds(1)));
  const auto risen = claims_.settle(0, kOurs, since + config_.restart_wait);
  ASSERT_TRUE(risen);
  EXPECT_EQ(risen->epoch(), 33u);
  EXPECT_EQ(claims_.size(), 0u);
}

TEST_F(ClaimsOfOne, PersistentClaimToOurIdIsReported) {
  const nanoseconds since = seconds(10);
  add(1, 33, since);
  EXPECT_FALSE(claims_.settle(0, kOurs, since + milliseconds(900)));
  EXPECT_TRUE(events_.take().empty());
  claims_.find(33)->receive(presence_of(1, 33), since + milliseconds(900), {});
  for (const int ms : {1001, 1100})
    EXPECT_FALSE(claims_.settle(0, kOurs, since + milliseconds(ms)));
  const auto events = events_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, PresenceEventKind::disputed);
}

TEST_F(ClaimsOfOne, AnotherIdIsAnotherClaim) {
  Claimant& claimant = add(2, 33, seconds(10));
  claimant.reported = true;
  claimant.receive(presence_of(3, 33), seconds(12), {});
  EXPECT_EQ(claimant.since, seconds(12));
  EXPECT_FALSE(claimant.reported);
}

TEST_F(ClaimsOfOne, FreeIdGoesToEstablishedThenOldestClaimant) {
  add(3, 44, seconds(10));
  add(3, 33, seconds(10));
  add(3, 55, seconds(10)).announced.flags |= pdu::kPresenceEstablished;
  add(2, 11, seconds(10));  // not free
  for (const std::uint32_t epoch : {55u, 33u, 44u}) {
    const auto risen = claims_.take_free(kOurs, seconds(11));
    ASSERT_TRUE(risen);
    EXPECT_EQ(risen->epoch(), epoch);
  }
  EXPECT_FALSE(claims_.take_free(kOurs, seconds(11)));
  EXPECT_TRUE(claims_.contains({7, 2}));
}

TEST_F(ClaimsOfOne, SilentClaimantsAreDropped) {
  add(1, 33, seconds(10));
  EXPECT_FALSE(claims_.settle(0, kOurs, seconds(10) + config_.patience()));
  EXPECT_EQ(claims_.size(), 1u);
  EXPECT_FALSE(claims_.settle(0, kOurs, seconds(10) + config_.patience() + nanoseconds(1)));
  EXPECT_EQ(claims_.size(), 0u);
}

}  // namespace
}  // namespace reckon::aoim
