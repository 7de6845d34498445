// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/cell_leadership.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr CellId kCell{3, -2};

pdu::CellRole claim(std::uint64_t entered, std::uint16_t flags = pdu::kRoleLeads,
                    std::uint32_t successor = 0) {
  pdu::CellRole role;
  role.column = kCell.q;
  role.row = kCell.r;
  role.entered = entered;
  role.flags = flags;
  role.successor = successor;
  return role;
}

// One peer, stepped every 10 ms.
struct One {
  explicit One(std::uint32_t epoch, nanoseconds utc = seconds(1000)) : cells({}, epoch) {
    cells.enter(kCell, utc, now);
  }
  std::vector<pdu::CellRole> run(nanoseconds length) {
    std::vector<pdu::CellRole> said;
    for (const nanoseconds end = now + length; now < end; now += milliseconds(10)) {
      cells.step(now);
      pdu::CellRole role;
      while (cells.take_role(now, role)) said.push_back(role);
    }
    return said;
  }
  nanoseconds now = seconds(50);
  CellLeadership cells;
};

TEST(CellLeadership, LeadsAloneAfterListening) {
  One one(7);
  one.run(milliseconds(1500));
  EXPECT_EQ(one.cells.leader(kCell), 0U);
  one.run(milliseconds(200));
  EXPECT_TRUE(one.cells.leads(kCell));
  EXPECT_EQ(one.run(seconds(10)).size(), 20U) << "a heartbeat every 0.5 s";
}

// Both peers would lead after their listening time. The start stagger of the first makes both end
// at the same time if the other came that much later.
TEST(CellLeadership, WaitsForLaterPeerWithAnEarlierClock) {
  One one(7);
  one.run(milliseconds(200));
  one.cells.receive(claim(5, 0), 9, one.now);
  one.run(milliseconds(1610));
  EXPECT_EQ(one.cells.leader(kCell), 0U) << "the other has listened now";
  one.cells.receive(claim(5, 0), 9, one.now);
  one.run(milliseconds(180));
  EXPECT_EQ(one.cells.leader(kCell), 0U) << "and has not been heard to lead";
  one.run(milliseconds(20));
  EXPECT_TRUE(one.cells.leads(kCell));
}

TEST(CellLeadership, WaitsAtMostTwiceItsListeningTime) {
  One one(7);
  for (std::uint32_t life = 10; life < 63; ++life) {  // each with an earlier clock than ours
    one.cells.receive(claim(5, 0), life, one.now);
    one.run(milliseconds(100));
  }
  EXPECT_TRUE(one.cells.leads(kCell)) << "after 3.2 s and ten staggers";
  One other(7);
  other.cells.receive(claim(5, 0), 9, other.now);
  other.run(milliseconds(1810));
  EXPECT_TRUE(other.cells.leads(kCell)) << "as long as that one is expected to";
}

TEST(CellLeadership, DoesNotUnseatLeaderWithALaterClock) {
  One one(7, seconds(1));  // a clock of 1970
  one.cells.receive(claim(5'000), 9, one.now);
  const auto said = one.run(milliseconds(100));
  EXPECT_EQ(one.cells.leader(kCell), 9U);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.back().flags, 0);
  EXPECT_EQ(said.back().entered, 1'000'000'000U) << "its own time where that is later";
  One early(8, nanoseconds(1));
  early.cells.receive(claim(5'000), 9, early.now);
  EXPECT_EQ(early.run(milliseconds(20)).back().entered, 5'001U) << "behind the leader";
}

TEST(CellLeadership, YieldsToTheLongerServingLeader) {
  One one(7);
  one.run(seconds(2));
  ASSERT_TRUE(one.cells.leads(kCell));
  one.cells.receive(claim(seconds(1001) / nanoseconds(1)), 9, one.now);
  EXPECT_TRUE(one.cells.leads(kCell)) << "younger";
  EXPECT_EQ(one.run(milliseconds(200)).size(), 1U) << "it says so again at once";
  EXPECT_TRUE(one.cells.came_later(kCell, 9));
  EXPECT_FALSE(one.cells.came_later(kCell, 10)) << "not heard";
  one.cells.receive(claim(1), 9, one.now);
  EXPECT_FALSE(one.cells.came_later(kCell, 9));
  EXPECT_EQ(one.cells.leader(kCell), 9U);
}

TEST(CellLeadership, NamesTheOldestMemberAsSuccessor) {
  One one(7);
  one.run(seconds(2));
  one.cells.receive(claim(2'000'000'000'000, 0), 20, one.now);
  one.cells.receive(claim(1'900'000'000'000, 0), 30, one.now);
  EXPECT_EQ(one.run(milliseconds(600)).back().successor, 30U);
  EXPECT_EQ(one.run(seconds(10)).back().successor, 0U) << "they have fallen silent";
}

TEST(CellLeadership, SuccessorLeadsWithinTwoSecondsOfADeath) {
  One heir(7), other(8);
  for (int beat = 0; beat < 4; ++beat) {
    for (One* one : {&heir, &other}) {
      one->cells.receive(claim(1, pdu::kRoleLeads, 7), 5, one->now);
      one->run(milliseconds(500));
    }
  }
  heir.run(milliseconds(990));
  EXPECT_FALSE(heir.cells.leads(kCell)) << "two heartbeats missed";
  heir.run(milliseconds(50));
  EXPECT_TRUE(heir.cells.leads(kCell)) << "three";
  other.run(milliseconds(1040));
  EXPECT_EQ(other.cells.leader(kCell), 5U) << "leaves it to the successor";
}

TEST(CellLeadership, NewcomerSucceedsALeaderThatLeavesAtOnce) {
  One heir(7), other(8), late(9);
  heir.cells.receive(claim(1, pdu::kRoleLeads | pdu::kRoleLeaves, 7), 5, heir.now);
  EXPECT_TRUE(heir.cells.leads(kCell));
  EXPECT_TRUE(heir.cells.had_other_leader(kCell)) << "it has to ask for what it was not told";
  other.cells.receive(claim(2'000'000'000'000, 0), 7, other.now);
  other.cells.receive(claim(1, pdu::kRoleLeads | pdu::kRoleLeaves, 7), 5, other.now);
  EXPECT_EQ(other.cells.leader(kCell), 7U) << "leaves it to the successor";
  late.cells.receive(claim(1, pdu::kRoleLeaves, 9), 5, late.now);
  EXPECT_EQ(late.cells.leader(kCell), 0U) << "who did not lead has nothing to leave";
  EXPECT_FALSE(late.cells.had_other_leader(kCell));
  heir.cells.receive(claim(1, pdu::kRoleLeads | pdu::kRoleLeaves, 8), 6, heir.now);
  EXPECT_TRUE(heir.cells.leads(kCell)) << "another's good-bye does not unseat it";
}

TEST(CellLeadership, SuccessorTakesOverAtOnceOnDeparture) {
  One heir(7);
  heir.cells.receive(claim(1, pdu::kRoleLeads, 7), 5, heir.now);
  heir.cells.receive(claim(1, pdu::kRoleLeads | pdu::kRoleLeaves, 7), 5, heir.now);
  EXPECT_TRUE(heir.cells.leads(kCell));
}

// This peer came just before the leader left and has not received the other members yet.
TEST(CellLeadership, DoesNotLeadBesideAnUnknownSuccessor) {
  One one(7);
  one.cells.receive(claim(5'000, pdu::kRoleLeads, 11), 9, one.now);
  one.run(milliseconds(100));
  one.cells.receive(claim(5'000, pdu::kRoleLeads | pdu::kRoleLeaves, 11), 9, one.now);
  one.run(milliseconds(600));
  EXPECT_FALSE(one.cells.leads(kCell));
  one.cells.receive(claim(6'000), 11, one.now);
  one.run(milliseconds(100));
  EXPECT_EQ(one.cells.leader(kCell), 11U);
}

TEST(CellLeadership, DepartsThreeTimesAndNamesItsSuccessor) {
  One one(7);
  one.run(seconds(2));
  one.cells.receive(claim(2'000'000'000'000, 0), 20, one.now);
  one.cells.leave(kCell, one.now);
  EXPECT_FALSE(one.cells.is_member(kCell));
  const auto said = one.run(seconds(3));
  ASSERT_EQ(said.size(), 3U);
  for (const pdu::CellRole& role : said) {
    EXPECT_EQ(role.flags, pdu::kRoleLeads | pdu::kRoleLeaves);
    EXPECT_EQ(role.successor, 20U);
  }
}

TEST(CellLeadership, ListensAgainAfterASuspension) {
  One one(7);
  one.run(seconds(3));
  one.now += seconds(4);
  one.run(milliseconds(20));
  EXPECT_FALSE(one.cells.leads(kCell));
  one.run(milliseconds(1700));
  EXPECT_TRUE(one.cells.leads(kCell)) << "nobody else does";
}

TEST(CellLeadership, KeepsToItsBounds) {
  LeaderConfig config;
  config.most_cells = 3;
  config.most_members = 4;
  CellLeadership cells(config, 7);
  for (std::int32_t i = 0; i < 10; ++i) {
    EXPECT_EQ(cells.enter({i, 0}, seconds(1), seconds(1)), i < 3);
  }
  pdu::CellRole role;
  for (std::uint32_t peer = 100; peer < 200; ++peer) cells.receive(role, peer, seconds(1));
  EXPECT_EQ(cells.members({0, 0}), 4U);
  EXPECT_EQ(cells.members({9, 0}), 0U);
}

}  // namespace
}  // namespace reckon::aoim
