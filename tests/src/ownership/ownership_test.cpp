// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hand-overs, failures and attacks, step by step. The seeded simulation (tests/fuzz/owners) draws
// the rest.
#include "reckon/peer/ownership/ownership.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/src/ownership/local_owners.hpp"

namespace reckon::peer {
namespace ownership_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

template <typename Message>
const Message* last_of(const LocalOwners& owners, std::uint32_t from) {
  for (auto sent = owners.sent.rbegin(); sent != owners.sent.rend(); ++sent) {
    if (sent->first == from && std::holds_alternative<Message>(sent->second))
      return &std::get<Message>(sent->second);
  }
  return nullptr;
}

TEST(Ownership, BeginsWithTheOldestPeer) {
  LocalOwners owners(3);
  owners.begin();
  EXPECT_TRUE(owners.owns(1, 0) && owners.owns(1, 1));
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_TRUE(owners[i].protocol.is_voter()) << i;
    EXPECT_EQ(owners[i].protocol.tenure(0), (Tenure{version_of(1, 0), 1})) << i;
  }
}

TEST(Ownership, GoesToAnAskerWithItsState) {
  LocalOwners owners(3);
  owners.begin();
  ObjectState state;
  state.position = {1.0, 2.0, 3.0};
  owners[1].protocol.set_state(1, state);
  owners[3].protocol.ask(1);
  owners.run(milliseconds(50));
  EXPECT_TRUE(owners.owns(3, 1));
  EXPECT_FALSE(owners.owns(1, 1));
  EXPECT_EQ(owners[3].protocol.granted_state(1).position, state.position);
  EXPECT_EQ(owners[2].protocol.tenure(1), (Tenure{version_of(1, 1), 3}));
}

TEST(Ownership, StaysWhileAHandHoldsIt) {
  LocalOwners owners(2);
  owners.begin();
  owners[1].busy.set(0);
  owners[2].protocol.ask(0);
  owners.run(seconds(2));
  EXPECT_TRUE(owners.owns(1, 0));
  owners[1].busy.reset(0);
  owners.run(milliseconds(50));
  EXPECT_TRUE(owners.owns(2, 0)) << "the owner remembers who asked";
}

TEST(Ownership, MovesObjectsInContactTogetherOrNot) {
  LocalOwners owners(2, 64);
  owners.begin();
  owners[1].company.set();
  owners[1].company &= ObjectSet(~0ULL);
  owners[1].busy.set(63);
  owners[2].protocol.ask(0);
  owners.run(seconds(1));
  for (std::size_t i = 0; i < 64; ++i) ASSERT_TRUE(owners.owns(1, i)) << i;
  owners[1].busy.reset(63);
  owners.run(milliseconds(50));
  for (std::size_t i = 0; i < 64; ++i) ASSERT_TRUE(owners.owns(2, i)) << i;
}

TEST(Ownership, IsNotGivenWhereTouchForbidsIt) {
  LocalOwners owners(2);
  owners.begin();
  owners[1].untouchable = 2;
  owners[2].protocol.ask(0);
  owners.run(seconds(2));
  EXPECT_TRUE(owners.owns(1, 0));
}

TEST(Ownership, PassesToTheNextPeerAfterAFailure) {
  LocalOwners owners(3);
  owners.begin();
  owners[1].runs = false;
  owners.run(milliseconds(2900));
  EXPECT_FALSE(owners.owns(2, 0)) << "the owner may still act";
  owners.run(milliseconds(700));
  EXPECT_TRUE(owners.owns(2, 0) && owners.owns(2, 1));
  EXPECT_FALSE(owners[3].protocol.acts().decided().roll.contains(1));
}

TEST(Ownership, RestsWithTheJuniorOfTwo) {
  LocalOwners owners(2);
  owners.begin();
  owners[2].runs = false;
  owners.run(seconds(5));
  EXPECT_TRUE(owners.owns(1, 0)) << "the senior goes on";
  owners[2].runs = true;
  owners.run(seconds(2));
  owners[1].runs = false;
  owners.run(seconds(10));
  EXPECT_FALSE(owners.owns(2, 0));
  EXPECT_FALSE(owners[2].protocol.has_lease(owners.now));
  owners[2].protocol.go_alone(1000, owners.now);
  EXPECT_TRUE(owners.owns(2, 0)) << "by the user's word";
  owners[1].runs = true;
  owners.run(seconds(4));
  EXPECT_TRUE(owners.owns(1, 0)) << "the senior's table wins";
  EXPECT_FALSE(owners.owns(2, 0));
  EXPECT_EQ(owners[2].protocol.counts().merged, 1U);
}

TEST(Ownership, CountsPeersOfAHostAsOneVote) {
  LocalOwners owners(4);
  for (std::size_t i = 1; i <= 4; ++i) owners[i].one_host = true;
  owners.begin();
  const auto voters = owners[1].protocol.acts().decided().roll.voters();
  ASSERT_EQ(voters.size(), 4U);
  for (const Voter& voter : voters) EXPECT_EQ(voter.host, voters[0].host);
}

TEST(Ownership, PassesAtOnceWhenTheOwnerLeaves) {
  LocalOwners owners(3);
  owners.begin();
  owners[1].protocol.leave();
  owners.run(milliseconds(500));
  EXPECT_TRUE(owners[1].protocol.has_left());
  EXPECT_TRUE(owners.owns(2, 0));
}

// Peer 3 grants to 2, which passes the object on to 1 and leaves. Peer 3 learns only of the act.
TEST(Ownership, StaysWithNextOwnerWhenTakerLeaves) {
  LocalOwners owners(3);
  owners.begin();
  owners[3].protocol.ask(0);
  owners.run(milliseconds(200));
  ASSERT_TRUE(owners.owns(3, 0));
  owners[3].protocol.withdraw(0);
  owners.loses = [](std::uint32_t, std::uint32_t to, const OwnershipMessage& message) {
    return to == 3 && std::holds_alternative<TableExtract>(message);
  };
  owners[2].protocol.ask(0);
  owners.run(milliseconds(100));
  owners[2].protocol.withdraw(0);
  owners[1].protocol.ask(0);
  owners.run(milliseconds(100));
  ASSERT_TRUE(owners.owns(1, 0));
  owners[2].protocol.leave();
  for (int i = 0; i < 100; ++i) {
    owners.run(milliseconds(10));
    ASSERT_FALSE(owners.owns(3, 0)) << "while peer 1 owns it";
  }
  EXPECT_FALSE(owners[3].protocol.acts().decided().roll.contains(2));
  owners.loses = [](auto, auto, const auto&) { return false; };
  owners.run(seconds(1));
  EXPECT_TRUE(owners.owns(1, 0));
  EXPECT_EQ(owners[3].protocol.tenure(0).owner, 1U);
}

TEST(Ownership, IsOldAtAPeerThatSlept) {
  LocalOwners owners(3);
  owners.begin();
  owners[1].runs = false;
  owners.run(seconds(8));
  EXPECT_TRUE(owners.owns(2, 0));
  EXPECT_FALSE(owners.owns(1, 0)) << "before its first step, too";
  owners[1].runs = true;
  owners.run(seconds(2));
  EXPECT_FALSE(owners.owns(1, 0));
  EXPECT_EQ(owners[1].protocol.tenure(0).owner, 2U);
  EXPECT_TRUE(owners[1].protocol.is_voter()) << "it votes again";
}

TEST(Ownership, NeedsAMajorityThatReceivesTheOwner) {
  LocalOwners owners(3);
  owners.begin();
  // The owner receives all others, and none receives it.
  owners.loses = [](std::uint32_t from, std::uint32_t, const auto&) { return from == 1; };
  owners.run(milliseconds(2300));
  EXPECT_FALSE(owners.owns(1, 0));
}

// Attacks. The sender of each message is proved by its address or seal.

TEST(OwnershipAttack, GrantsOfAStrangerAreRefused) {
  LocalOwners owners(3);
  owners.begin();
  owners[2].protocol.ask(0);
  owners[1].busy.set(0);
  owners.run(milliseconds(200));
  Grant forged;
  forged.world = owners[2].protocol.world();
  forged.transaction = 99;
  forged.to = 2;
  forged.round = last_of<Round>(owners, 2)->round;
  forged.lease_ms = 2000;
  forged.objects.set(0);
  forged.count = 1;
  forged.part[0] = {0, {version_of(1, 1), 2}};
  owners[2].protocol.receive(77, forged, owners.now);  // no voter
  EXPECT_FALSE(owners.owns(2, 0));
  owners[2].protocol.receive(3, forged, owners.now);  // a voter that does not own it
  EXPECT_FALSE(owners.owns(2, 0));
  EXPECT_GT(owners[2].protocol.counts().refused, 0U);
}

TEST(OwnershipAttack, UnwantedGrantsAreRefused) {
  LocalOwners owners(3);
  owners.begin();
  owners[2].protocol.ask(0);
  owners.run(milliseconds(100));
  const Grant* grant = last_of<Grant>(owners, 1);
  ASSERT_NE(grant, nullptr);
  const Grant replayed = *grant;
  owners[2].protocol.withdraw(0);
  owners[3].protocol.ask(0);
  owners.run(milliseconds(100));
  ASSERT_TRUE(owners.owns(3, 0));
  owners[2].protocol.receive(1, replayed, owners.now);
  EXPECT_FALSE(owners.owns(2, 0));
}

TEST(OwnershipAttack, AThirdPeerCannotClaimAnObject) {
  LocalOwners owners(3);
  owners.begin();
  TableExtract claim;
  claim.world = owners[1].protocol.world();
  claim.asks = true;
  claim.holdings.add(0, {version_of(1, 1), 3});
  owners[2].protocol.receive(3, claim, owners.now);
  EXPECT_EQ(owners[2].protocol.tenure(0).owner, 1U) << "nobody else has named the new owner";
  EXPECT_EQ(owners[2].protocol.counts().refused, 1U);
}

TEST(OwnershipAttack, NumbersOfTheFutureAreRefused) {
  LocalOwners owners(3);
  owners.begin();
  const WorldId world = owners[1].protocol.world();
  TableExtract far;
  far.world = world;
  far.holdings.add(0, {version_of(1000, 0), 3});
  far.holdings.add(1, {version_of(1, kMostHandOvers), 3});
  owners[2].protocol.receive(1, far, owners.now);
  EXPECT_EQ(owners[2].protocol.tenure(0).owner, 1U);
  EXPECT_EQ(owners[2].protocol.tenure(1).owner, 1U);
  Proposal high;
  high.world = world;
  high.act = owners[1].protocol.acts().decided();
  ++high.act.number;
  high.ballot = {~0U, 3};
  owners[2].protocol.receive(3, high, owners.now);
  EXPECT_EQ(owners[2].protocol.acts().pending(), nullptr);
  EXPECT_LT(owners[2].protocol.acts().promised().attempt, 1000U);
}

TEST(OwnershipAttack, ProposalsAgainstALivingPeerFail) {
  LocalOwners owners(3);
  owners.begin();
  Proposal proposal;
  proposal.world = owners[1].protocol.world();
  proposal.act = owners[1].protocol.acts().decided();
  ++proposal.act.number;
  proposal.act.remove(1);
  proposal.act.chair = 3;
  proposal.act.given.set(0);
  proposal.ballot = {1, 3};
  proposal.digest = owners[2].protocol.table().digest(proposal.act.given);
  owners[2].protocol.receive(3, proposal, owners.now);
  EXPECT_EQ(owners[2].protocol.acts().pending(), nullptr);
  owners.run(seconds(1));
  EXPECT_TRUE(owners.owns(1, 0));
}

TEST(OwnershipAttack, AVoterThatConfirmsNothingIsOutvoted) {
  LocalOwners owners(4);
  owners.begin();
  // Peer 4 announces itself and confirms nobody.
  owners.loses = [](std::uint32_t, std::uint32_t to, const auto&) { return to == 4; };
  owners.run(seconds(5));
  EXPECT_TRUE(owners.owns(1, 0) && owners.owns(1, 1));
  owners[2].protocol.ask(0);
  owners.run(milliseconds(200));
  EXPECT_TRUE(owners.owns(2, 0));
}

}  // namespace ownership_test
}  // namespace reckon::peer
