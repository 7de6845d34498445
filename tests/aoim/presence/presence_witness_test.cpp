// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Owner of an id that two peers have held for a long time: statements of witnesses, and when they
// suffice; and claims of peers that have fallen silent.
#include <gtest/gtest.h>

#include <initializer_list>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

constexpr std::uint32_t kOwn = 900, kRival = 66, kWitness = 22;
constexpr PeerId kId{7, 1};

// A peer that has held its id for a long time, and one that claims the same id with an earlier
// start.
class Dispute : public testing::Test {
 protected:
  Dispute() : presence_({}, presence_of(1, kOwn, 100)) { presence_.start(now_); }

  void run(int length_ms, bool rival_speaks) {
    for (int ms = 0; ms < length_ms; ++ms, now_ += milliseconds(1)) {
      if (rival_speaks && ms % 200 == 0) rival();
      if (ms % 300 == 0) presence_.note_alive(kWitness, now_);
      (void)presence_.step(now_);
    }
  }
  void rival() { presence_.receive(established(presence_of(1, kRival, 0)), now_, source(99)); }
  void witness_comes() {
    presence_.receive(presence_of(2, kWitness), now_, source(2));
    presence_.note_alive(kWitness, now_);
  }
  void witness_lists(std::initializer_list<std::uint32_t> heard) {
    Octets octets;
    for (const std::uint32_t epoch : heard) octets = octets + record_octets(pdu::PeerEpoch{epoch});
    pdu::PeersHeard list;
    list.epoch = kWitness;
    list.epochs = octets;
    presence_.receive(list, now_, source(2));
  }

  nanoseconds now_ = seconds(50);
  Presence presence_;
};

TEST_F(Dispute, IsLostEarlierByUnanimousWitnesses) {
  witness_comes();
  run(3000, false);
  rival();
  run(100, true);
  witness_lists({kRival});
  run(1100, true);
  EXPECT_EQ(presence_.id(), kId);
  run(400, true);
  EXPECT_NE(presence_.id(), kId);
}

TEST_F(Dispute, WaitsForAWitnessWithoutAListYet) {
  run(3000, false);
  run(3000 - 500, true);
  witness_comes();
  run(900, true);
  EXPECT_EQ(presence_.id(), kId) << "seniority decides where nobody will say whom he hears";
  witness_lists({kOwn});
  run(3000, true);
  EXPECT_EQ(presence_.id(), kId);
}

TEST_F(Dispute, WaitsForAWitnessThatWasCutOff) {
  witness_comes();
  run(3000, false);
  witness_lists({});
  run(3000, true);
  EXPECT_EQ(presence_.id(), kId);
  witness_lists({kRival});
  run(500, true);
  EXPECT_NE(presence_.id(), kId);
}

TEST_F(Dispute, IsSettledBySeniorityWithoutLists) {
  witness_comes();
  run(3000, false);
  run(3000, true);
  EXPECT_NE(presence_.id(), kId);
}

TEST_F(Dispute, IsNotLostToASilentRival) {
  witness_comes();
  run(3000, false);
  run(1100, true);
  run(1200, false);
  witness_lists({kRival});
  run(1500, false);
  EXPECT_EQ(presence_.id(), kId);
}

// The rival is nearer to the witnesses and is always received first under our new id.
TEST(PresenceFollowed, RivalBelievedByAllCausesFewMoves) {
  Presence presence({}, presence_of(1, kOwn, 100));
  presence.start(seconds(50));
  std::size_t moves = 0;
  for (int ms = 0; ms < 14'000; ++ms) {
    const nanoseconds now = seconds(50) + milliseconds(ms);
    pdu::Presence rival = presence.own();
    rival.epoch = kRival;
    rival.started = 0;
    if (ms % 100 == 0) presence.receive(rival, now, source(99));
    if (ms % 300 == 0) presence.receive(presence_of(2, kWitness), now, source(2));
    const Octets heard = record_octets(pdu::PeerEpoch{kRival});
    pdu::PeersHeard list;
    list.epoch = kWitness;
    list.epochs = heard;
    if (ms % 300 == 150) presence.receive(list, now, source(2));
    (void)presence.step(now);
    for (const Kind kind : kinds(presence)) moves += kind == Kind::identity_changed ? 1 : 0;
  }
  EXPECT_LE(moves, 6u);
  EXPECT_GE(moves, 3u);
}

// The newcomer receives the rival before its own two seconds are over, and would yield after them.
TEST(PresenceClaim, NewcomerDoesNotGetALongHeldId) {
  for (const bool rival_has_held : {false, true}) {
    Presence presence({}, presence_of(1, kOwn, 100));
    presence.start(seconds(10));
    for (int ms = 0; ms < 2500; ++ms) {
      const nanoseconds now = seconds(10) + milliseconds(ms);
      const pdu::Presence rival = presence_of(1, kRival, 0);
      if (ms == 1950) presence.receive(rival_has_held ? established(rival) : rival, now);
      (void)presence.step(now);
    }
    EXPECT_EQ(presence.id() == kId, !rival_has_held);
  }
}

// Otherwise a caller that waits for next_step() would not wait at all while the claim is kept.
TEST(PresenceClaim, NothingIsOverdueAfterASuspension) {
  Presence presence({}, presence_of(1, kOwn));
  presence.receive(presence_of(2, kWitness), seconds(1));
  presence.receive(presence_of(2, kRival), seconds(2));
  presence.receive(presence_of(2, kRival), seconds(2) + milliseconds(400));
  presence.note_alive(kWitness, seconds(2) + milliseconds(400));
  (void)presence.step(seconds(2) + milliseconds(400));
  const nanoseconds now = seconds(2) + milliseconds(1450);
  presence.note_alive(kWitness, now);
  (void)presence.step(now);
  EXPECT_GT(presence.next_step(), now);
}

TEST(PresenceClaim, HolderThatAnsweredSurvivesASecondOfSilence) {
  Presence presence({}, presence_of(1, kOwn));
  presence.receive(presence_of(2, kWitness), seconds(1));
  for (int ms = 0; ms <= 1500; ++ms) {
    const nanoseconds now = seconds(3) + milliseconds(ms);
    if (ms % 150 == 0) presence.receive(presence_of(2, kRival), now);
    if (ms == 320 || ms == 1320) presence.note_alive(kWitness, now);
    (void)presence.step(now);
  }
  EXPECT_EQ(presence.epoch_of({7, 2}), kWitness);
}

TEST(PresenceClaim, SilentClaimantDoesNotGetAFreedId) {
  Presence presence({}, presence_of(1, kOwn));
  presence.receive(presence_of(2, kWitness), seconds(1));
  presence.receive(presence_of(2, kRival), seconds(2));
  for (int ms = 0; ms <= 2600; ms += 100) {
    presence.note_alive(kWitness, seconds(2) + milliseconds(ms));
    (void)presence.step(seconds(2) + milliseconds(ms));
  }
  const nanoseconds now = seconds(2) + milliseconds(2600);
  presence.receive(leaving(presence_of(2, kWitness)), now);
  (void)presence.step(now);
  EXPECT_FALSE(presence.epoch_of({7, 2}));
  EXPECT_GT(presence.next_step(), now);
  presence.receive(presence_of(2, kRival), now + milliseconds(100));
  EXPECT_EQ(presence.epoch_of({7, 2}), kRival);
}

}  // namespace
}  // namespace reckon::aoim
