// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Ownership of ids: races, restarts, disputes, partitions.
#include <gtest/gtest.h>

#include "reckon/tests/aoim/support/segment.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

struct Race {
  std::size_t peers;
  double loss;
};

class PresenceRace : public testing::TestWithParam<Race> {};

TEST_P(PresenceRace, AllAgreeOnDistinctIdsWithinTwoSeconds) {
  for (std::uint64_t seed = 1; seed <= reckon::test::tries(3U, 10U); ++seed) {
    Segment segment(seed, GetParam().loss);
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < GetParam().peers; ++i) {
      segment.add(presence_of(1, static_cast<std::uint32_t>(random() | 1), 100));
    }
    segment.run(seconds(2));
    EXPECT_TRUE(segment.agree()) << "seed " << seed;
    const std::size_t changes = segment.count(Kind::identity_changed);
    segment.run(seconds(4));
    EXPECT_TRUE(segment.agree()) << "seed " << seed;
    EXPECT_EQ(segment.count(Kind::identity_changed), changes) << "seed " << seed;
    EXPECT_EQ(segment.count(Kind::timed_out), 0u) << "seed " << seed;
    EXPECT_EQ(segment.count(Kind::restarted), 0u) << "the living were buried, seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(OneInstant, PresenceRace,
                         testing::Values(Race{2, 0}, Race{8, 0}, Race{32, 0}, Race{64, 0},
                                         Race{2, 0.05}, Race{8, 0.05}, Race{32, 0.05},
                                         Race{64, 0.05}, Race{2, 0.2}, Race{8, 0.2}, Race{32, 0.2},
                                         Race{64, 0.2}),
                         [](const auto& race) {
                           return std::to_string(race.param.peers) + "PeersLoss" +
                                  std::to_string(static_cast<int>(100 * race.param.loss + 0.5));
                         });

TEST(PresenceIdentity, NewEpochUnderLiveIdBecomesARestart) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  (void)presence.take_events();
  presence.receive(presence_of(2, 33), seconds(3));
  EXPECT_EQ(presence.standing(33), Standing::unknown);
  EXPECT_EQ(presence.next_step(), seconds(3) + milliseconds(500));
  (void)presence.step(seconds(3) + milliseconds(499));
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
  (void)presence.step(seconds(3) + milliseconds(500));
  const auto events = presence.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::restarted);
  EXPECT_EQ(events[0].former_epoch, 22u);

  presence.receive(presence_of(2, 22), seconds(4));  // a late announcement of the former epoch
  presence.receive(leaving(presence_of(2, 22)), seconds(4));
  EXPECT_TRUE(presence.take_events().empty());
  EXPECT_EQ(presence.counts().former_life, 2u);
  EXPECT_EQ(presence.standing(22), Standing::former_life);
  EXPECT_EQ(presence.standing(33), Standing::member);
  EXPECT_EQ(presence.standing(44), Standing::unknown);
  EXPECT_EQ(presence.standing(11), Standing::own);
}

TEST(PresenceIdentity, RestartIsSeenDespiteLateDatagrams) {
  for (int late_ms = -200; late_ms <= 200; late_ms += 25) {
    Presence presence({}, presence_of(1, 11));
    presence.receive(presence_of(2, 22), seconds(1));
    for (int ms = 0; ms <= 1000; ++ms) {
      const nanoseconds now = seconds(2) + milliseconds(ms);
      if (ms % 150 == 0) presence.receive(presence_of(2, 33), now);
      if (ms == late_ms) presence.note_alive(22, now);
      (void)presence.step(now);
    }
    EXPECT_EQ(presence.epoch_of({7, 2}), 33u) << late_ms << " ms";
  }
}

TEST(PresenceIdentity, AnActivePeerKeepsItsId) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  (void)presence.take_events();
  for (int ms = 0; ms <= 10'000; ++ms) {
    const nanoseconds now = seconds(2) + milliseconds(ms);
    if (ms % 20 == 0) presence.receive(established(presence_of(2, 33, 0)), now);
    if (ms % 400 == 0) presence.note_alive(22, now);
    (void)presence.step(now);
  }
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
  EXPECT_EQ(kinds(presence), (std::vector<Kind>{Kind::disputed}));
}

TEST(PresenceIdentity, OneForgedAnnouncementDisplacesNobody) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  presence.receive(presence_of(2, 33, 0), seconds(1) + milliseconds(300));
  for (int ms = 700; ms < 20'000; ++ms) {
    const bool speaks = ms == 700 || (ms >= 4500 && ms % 1000 == 500);  // three are lost in between
    if (speaks) presence.receive(presence_of(2, 22), seconds(1) + milliseconds(ms));
    (void)presence.step(seconds(1) + milliseconds(ms));
    ASSERT_EQ(presence.epoch_of({7, 2}), 22u) << ms << " ms";
  }
}

TEST(PresenceIdentity, DisplacedPeerReturnsWhenItsIdIsFree) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  presence.receive(presence_of(2, 33), seconds(2));
  (void)presence.step(seconds(3));
  ASSERT_EQ(presence.epoch_of({7, 2}), 33u);
  presence.receive(presence_of(2, 22), seconds(5));
  EXPECT_EQ(presence.epoch_of({7, 2}), 33u);
  presence.receive(presence_of(9, 33), seconds(5) + milliseconds(100));
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
  EXPECT_EQ(presence.epoch_of({7, 9}), 33u);
}

TEST(PresenceIdentity, DepartureConcernsItsEpochOnly) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  presence.receive(presence_of(2, 33), seconds(1));
  presence.receive(leaving(presence_of(2, 33)), seconds(1) + milliseconds(10));
  presence.receive(leaving(presence_of(2, 44)), seconds(1) + milliseconds(10));
  (void)presence.step(seconds(3));
  EXPECT_EQ(presence.epoch_of({7, 2}), 22u);
}

TEST(PresenceIdentity, NewNumberUnderKnownEpochIsARename) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1));
  (void)presence.take_events();
  presence.receive(presence_of(5, 22), seconds(2));
  const auto events = presence.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::renamed);
  EXPECT_EQ(events[0].former, (PeerId{7, 2}));
  EXPECT_EQ(events[0].peer(), (PeerId{7, 5}));
  EXPECT_EQ(presence.peers().size(), 1u);
}

TEST(PresenceIdentity, StaleAnnouncementWithoutProofRenamesNobody) {
  Presence presence({}, presence_of(1, 11));
  pdu::Presence former = presence_of(2, 22), latter = presence_of(5, 22);
  former.send_time = 1'000'000;
  latter.send_time = 2'000'000;
  presence.receive(latter, seconds(1));
  presence.receive(former, seconds(1) + milliseconds(1));
  EXPECT_EQ(presence.id_of(22), (PeerId{7, 5}));
}

TEST(PresenceIdentity, LetsTheEstablishedKeepADisputedAddress) {
  Segment segment(1, 0.0);
  segment.add(presence_of(1, 900, 100));
  segment.run(seconds(10));
  segment.add(presence_of(1, 5, 0));  // claims an earlier start
  segment.run(milliseconds(300));
  EXPECT_EQ(segment[0].id(), (PeerId{7, 1}));
  EXPECT_NE(segment[1].id(), (PeerId{7, 1}));
  EXPECT_TRUE(segment.agree());
  EXPECT_EQ(segment.count(0, Kind::identity_changed), 0u);
  EXPECT_EQ(segment.count(1, Kind::identity_changed), 1u);
}

TEST(PresenceIdentity, BystanderReceivesBothPartiesAfterADispute) {
  Segment segment(5, 0.0);
  segment.add(presence_of(3, 333, 50));
  segment.run(seconds(3));
  segment.add(presence_of(1, 222, 100));
  segment.add(presence_of(1, 111, 100));
  segment.run(seconds(2));
  EXPECT_TRUE(segment.agree());
  EXPECT_EQ(segment[2].id(), (PeerId{7, 1})) << "the lower epoch of one second";
  EXPECT_EQ(segment.count(0, Kind::departed), 0u);
  EXPECT_EQ(segment.count(Kind::timed_out), 0u);
}

// A stranger may claim anything: a peer that others receive keeps its id.
TEST(PresenceIdentity, ForgedSeniorityEvictsNoReceivedPeer) {
  Segment segment(7, 0.0);
  segment.add(presence_of(1, 900, 100));
  segment.add(presence_of(2, 901, 100));
  segment.run(seconds(3));
  for (int i = 0; i < 200; ++i) {
    for (std::size_t peer = 0; peer < 2; ++peer) {
      segment[peer].receive(established(presence_of(1, 66, 0)), segment.now(), source(99));
    }
    segment.run(milliseconds(50));
  }
  EXPECT_EQ(segment[0].id(), (PeerId{7, 1}));
  EXPECT_EQ(segment[1].epoch_of({7, 1}), 900u);
  EXPECT_EQ(segment.count(Kind::identity_changed), 0u);
  EXPECT_EQ(segment.count(0, Kind::disputed), 1u);
  EXPECT_EQ(segment.count(1, Kind::disputed), 1u);
}

pdu::Presence numbered(pdu::Presence presence, std::uint8_t number) {
  presence.scene_peer = number;
  return presence;
}

TEST(PresenceIdentity, TakesTheFirstFreeNumberOfTheScene) {
  Presence presence({}, numbered(presence_of(5, 11), pdu::kScenePeerWanted));
  presence.receive(numbered(presence_of(1, 21), 1), seconds(1));
  presence.receive(numbered(presence_of(2, 22), 3), seconds(1));
  presence.receive(numbered(presence_of(3, 23), 0), seconds(1));  // has no number of the scene
  pdu::Presence other = numbered(presence_of(4, 24), 2);
  other.scene_hash = 1;
  presence.receive(other, seconds(1));
  presence.take_scene_peer();
  EXPECT_EQ(presence.own().scene_peer, 2);
}

TEST(PresenceIdentity, FreeNumbersGoInTheOrderOfIds) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Segment segment(seed, 0.05);
    for (std::uint32_t i = 0; i < 8; ++i) {
      segment.add(numbered(presence_of(1, static_cast<std::uint32_t>(7919 * seed + i)),
                           i == 0 ? std::uint8_t{3} : pdu::kScenePeerWanted));
    }
    segment.run(seconds(2));
    std::set<int> numbers{3};
    for (std::size_t i = 1; i < segment.size(); ++i) {
      segment[i].take_scene_peer();
      numbers.insert(segment[i].own().scene_peer);
    }
    EXPECT_EQ(numbers, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8})) << "seed " << seed;
  }
}

struct Split {
  std::size_t left, right;
};

class PresenceSplit : public testing::TestWithParam<Split> {};

// Both halves have held the same ids for a long time when they meet.
TEST_P(PresenceSplit, HealsWithAtMostOneRenamePerPeer) {
  const auto [left, right] = GetParam();
  for (const double loss : {0.0, 0.2}) {
    for (std::uint64_t seed = 1; seed <= reckon::test::tries(4U, 10U); ++seed) {
      Segment segment(seed, loss);
      segment.cut([n = left](std::size_t a, std::size_t b) { return (a < n) != (b < n); });
      for (std::size_t i = 0; i < left + right; ++i) {
        const auto number = static_cast<std::uint16_t>(1 + (i < left ? i : i - left));
        segment.add(presence_of(number, static_cast<std::uint32_t>(1000 * seed + 7 * i), 100));
        segment.run(milliseconds(200));
      }
      segment.run(seconds(10));
      ASSERT_EQ(segment.count(Kind::identity_changed), 0u);
      segment.cut({});
      segment.run(loss > 0.0 ? seconds(12) : seconds(4));
      EXPECT_TRUE(segment.agree()) << "seed " << seed << " loss " << loss;
      for (std::size_t i = 0; i < segment.size(); ++i) {
        EXPECT_LE(segment.count(i, Kind::identity_changed), 1u) << "seed " << seed;
        if (left > right && i < left && loss == 0.0) {
          EXPECT_EQ(segment.count(i, Kind::identity_changed), 0u) << "seed " << seed;
        }
      }
      EXPECT_EQ(segment.count(Kind::restarted), 0u) << "seed " << seed << " loss " << loss;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PresenceSplit,
                         testing::Values(Split{1, 1}, Split{2, 2}, Split{3, 1}, Split{4, 3},
                                         Split{8, 8}));

TEST(PresenceClaim, OfASilentClaimantLeavesNothingOverdue) {
  Presence presence({}, presence_of(1, 11));
  presence.start(seconds(1));
  (void)presence.step(seconds(1));
  presence.receive(presence_of(2, 22), seconds(1));
  for (const int ms : {4000, 5000, 6000}) (void)presence.step(milliseconds(ms));
  presence.note_alive(22, seconds(6));
  presence.receive(presence_of(2, 33), milliseconds(6100));
  presence.note_alive(22, milliseconds(6400));  // it is alive: the other waits for its silence
  presence.receive(presence_of(2, 33), milliseconds(6450));
  for (const int ms : {7000, 8000, 8800}) (void)presence.step(milliseconds(ms));
  ASSERT_EQ(presence.epoch_of({7, 2}), 22u);
  const nanoseconds now = milliseconds(9000);  // the other has been silent for 2.55 s, too
  (void)presence.step(now);
  (void)presence.take_list(now);
  EXPECT_EQ(presence.epoch_of({7, 2}), 33u);
  EXPECT_GT(presence.next_step(), now);
}

TEST(PresenceClaim, IsSettledInOneStepForFreedId) {
  Presence presence({}, presence_of(1, 11));
  presence.start(seconds(1));
  presence.receive(presence_of(2, 22), seconds(10));
  for (int ms = 1000; ms <= 15'100; ms += 1000) (void)presence.step(milliseconds(ms));
  (void)presence.step(milliseconds(15'050));
  presence.receive(presence_of(2, 33), milliseconds(15'060));
  presence.receive(presence_of(2, 44), milliseconds(15'060));
  presence.receive(presence_of(2, 33), seconds(16));
  presence.receive(presence_of(2, 44), seconds(16));
  (void)presence.take_events();
  const nanoseconds now = milliseconds(16'110);  // the holder has timed out
  (void)presence.step(now);
  (void)presence.take_list(now);
  EXPECT_EQ(presence.epoch_of({7, 2}), 33u);
  EXPECT_GT(presence.next_step(), now);
  EXPECT_EQ(kinds(presence), (std::vector<Kind>{Kind::timed_out, Kind::newcomer, Kind::disputed}));
}

}  // namespace
}  // namespace reckon::aoim
