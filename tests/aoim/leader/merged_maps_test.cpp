// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two leaders of the scene on two sides of a partition, which ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "reckon/aoim/leader/leader_role.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr CellId kHere{1, 0}, kThere{2, 0};
constexpr std::uint32_t kElder = 7, kYounger = 9;

LeaderConfig config() {
  LeaderConfig config;
  config.pool = 4;
  return config;
}

// One side, stepped every 10 ms.
struct Side {
  Side(std::uint32_t epoch, nanoseconds utc, CellId cell) : role(config(), 4, epoch) {
    role.start(utc, now);
    role.enter(cell, GroupIndex{3}, utc, now);
  }
  // PDUs that it sends meanwhile.
  std::vector<std::vector<std::byte>> run(nanoseconds length) {
    std::vector<std::vector<std::byte>> said;
    for (const nanoseconds end = now + length; now < end; now += milliseconds(10)) {
      role.step(now, {}, [&said](GroupIndex, std::span<const std::byte> pdu) {
        said.emplace_back(pdu.begin(), pdu.end());
      });
    }
    return said;
  }
  void hear(const std::vector<std::vector<std::byte>>& said, std::uint32_t sender) {
    for (const std::vector<std::byte>& octets : said) {
      pdu::CellRoles roles;
      pdu::GroupMap map;
      if (pdu::decode(octets, roles) == pdu::DecodeError::none) role.receive(roles, sender, now);
      if (pdu::decode(octets, map) == pdu::DecodeError::none) role.receive(map, sender, now, now);
    }
  }
  nanoseconds now = seconds(50);
  LeaderRole role;
};

bool is_map(const std::vector<std::byte>& octets) {
  pdu::GroupMap map;
  return pdu::decode(octets, map) == pdu::DecodeError::none;
}

// Both have assigned the first group to a cell of their own. The younger receives the elder, which
// has not received the younger.
struct Meeting {
  Meeting() {
    elder.run(seconds(3));
    younger.run(seconds(3));
    younger.hear(elder.run(milliseconds(600)), kElder);
  }
  Side elder{kElder, seconds(1000), kHere}, younger{kYounger, seconds(1001), kThere};
};

TEST(LeaderRole, WithdrawsASharedGroupFromBothCells) {
  Meeting met;
  ASSERT_EQ(met.elder.role.group(kHere, met.elder.now), GroupIndex{1});
  ASSERT_EQ(met.younger.role.group(kThere, met.younger.now), GroupIndex{1});
  met.elder.hear(met.younger.run(milliseconds(100)), kYounger);
  met.elder.run(milliseconds(200));
  EXPECT_TRUE(met.elder.role.leads(kWholeScene));
  EXPECT_FALSE(met.younger.role.leads(kWholeScene));
  EXPECT_NE(met.elder.role.group(kHere, met.elder.now), GroupIndex{1}) << "in quarantine";
}

TEST(LeaderRole, RepeatsItsLastMapForTheOtherLeader) {
  Meeting met;
  auto said = met.younger.run(milliseconds(1400));
  EXPECT_EQ(std::count_if(said.begin(), said.end(), is_map), 3);
  said.erase(said.begin(), std::find_if(said.begin(), said.end(), is_map) + 1);
  met.elder.hear(said, kYounger);
  met.elder.run(milliseconds(200));
  EXPECT_NE(met.elder.role.group(kHere, met.elder.now), GroupIndex{1});
}

// A cell returned its group just before its leader yielded: peers that missed this still use the
// group.
TEST(LeaderRole, WithdrawsAGroupQuarantinedByTheOtherSide) {
  Side elder(kElder, seconds(1000), kHere), younger(kYounger, seconds(1001), kThere);
  elder.run(seconds(9));
  younger.run(seconds(3));
  younger.role.leave(kThere, younger.now);
  younger.run(seconds(6));
  ASSERT_FALSE(younger.role.group(kThere, younger.now)) << "empty for 5 s";
  ASSERT_EQ(elder.role.group(kHere, elder.now), GroupIndex{1});
  younger.hear(elder.run(milliseconds(600)), kElder);
  elder.hear(younger.run(milliseconds(100)), kYounger);
  elder.run(milliseconds(200));
  ASSERT_TRUE(elder.role.leads(kWholeScene));
  EXPECT_NE(elder.role.group(kHere, elder.now), GroupIndex{1}) << "in quarantine";
  EXPECT_EQ(elder.role.directory().entries().size(), 1U);
  younger.hear(elder.run(milliseconds(2100)), kElder);
  EXPECT_EQ(younger.role.directory().entries().size(), 1U) << "cells, not groups that rest";
}

// A leader starts with all idle groups in quarantine; that alone is no evidence of their use.
TEST(LeaderRole, LosesNothingToALeaderWithoutReturnedGroups) {
  Side elder(kElder, seconds(1000), kHere), younger(kYounger, seconds(1001), kHere);
  younger.hear(elder.run(seconds(4)), kElder);
  younger.run(seconds(4));
  ASSERT_TRUE(younger.role.leads(kWholeScene));
  elder.role.enter(kThere, GroupIndex{4}, seconds(1004), elder.now);
  elder.run(seconds(4));
  ASSERT_EQ(elder.role.group(kThere, elder.now), GroupIndex{2});
  younger.hear(elder.run(milliseconds(600)), kElder);
  elder.hear(younger.run(milliseconds(100)), kYounger);
  elder.run(milliseconds(200));
  EXPECT_EQ(elder.role.group(kHere, elder.now), GroupIndex{1});
  EXPECT_EQ(elder.role.group(kThere, elder.now), GroupIndex{2});
}

// The elder's map arrives before its claim: groups of the elder alone must not go to quarantine.
TEST(LeaderRole, YieldingLeaderTakesNothingFromTheElder) {
  constexpr CellId kFarther{5, 0};
  Side elder(kElder, seconds(1000), kHere), younger(kYounger, seconds(1001), kThere);
  elder.role.enter(kFarther, GroupIndex{4}, seconds(1000), elder.now);
  elder.run(seconds(3));
  younger.run(seconds(3));
  ASSERT_EQ(elder.role.group(kFarther, elder.now), GroupIndex{2});
  ASSERT_EQ(younger.role.group(kThere, younger.now), GroupIndex{1});
  auto said = elder.run(milliseconds(2100));
  std::stable_partition(said.begin(), said.end(), is_map);
  ASSERT_TRUE(is_map(said.front()));
  younger.hear(said, kElder);
  elder.hear(younger.run(milliseconds(100)), kYounger);
  elder.run(milliseconds(200));
  ASSERT_TRUE(elder.role.leads(kWholeScene));
  EXPECT_NE(elder.role.group(kHere, elder.now), GroupIndex{1}) << "both had given it away";
  EXPECT_EQ(elder.role.group(kFarther, elder.now), GroupIndex{2});
}

// Peers that slept meanwhile have its former map and treat lower versions as stale.
TEST(LeaderRole, NeverCountsItsMapsLowerThanBefore) {
  Side elder(kElder, seconds(1000), kHere), one(kYounger, seconds(1001), kThere);
  one.run(seconds(3));
  for (std::int32_t column = 10; column < 13; ++column) {
    one.role.enter({column, 0}, GroupIndex{3}, seconds(1001), one.now);
    one.run(milliseconds(300));
  }
  const std::uint32_t before = one.role.directory().version();
  elder.run(seconds(3));
  one.hear(elder.run(milliseconds(2100)), kElder);
  ASSERT_EQ(one.role.leader(kWholeScene), kElder);
  ASSERT_LT(one.role.directory().version(), before);
  one.run(seconds(4));
  ASSERT_TRUE(one.role.leads(kWholeScene));
  EXPECT_GT(one.role.directory().version(), before);
}

// The newcomer received no datagram of the leader, whose map is still valid for others. It received
// only one of those others.
TEST(LeaderRole, NewcomerQuarantinesGroupsOfAnUnreceivedLeader) {
  constexpr std::uint32_t kWitness = 11;
  Side elder(kElder, seconds(1000), kHere), witness(kWitness, seconds(1002), kHere);
  elder.run(seconds(3));
  witness.hear(elder.run(milliseconds(2100)), kElder);
  ASSERT_EQ(witness.role.group(kHere, witness.now), GroupIndex{1});
  const auto told = witness.run(seconds(1));

  Side newcomer(kYounger, seconds(1001), kThere), alone(kYounger, seconds(1001), kThere);
  newcomer.hear(told, kWitness);
  for (Side* side : {&newcomer, &alone}) {
    side->run(seconds(10));
    ASSERT_TRUE(side->role.leads(kWholeScene));
  }
  EXPECT_EQ(alone.role.group(kThere, alone.now), GroupIndex{1}) << "nobody led before";
  EXPECT_FALSE(newcomer.role.group(kThere, newcomer.now)) << "it may be in use";
  newcomer.run(seconds(30));
  EXPECT_TRUE(newcomer.role.group(kThere, newcomer.now)) << "after the quarantine";
}

// It read its socket late: meanwhile the groups of that map may belong to other cells.
TEST(LeaderRole, AgesAMapFromItsArrivalTime) {
  Side elder(kElder, seconds(1000), kHere), one(kYounger, seconds(1001), kThere);
  const auto said = elder.run(seconds(4));
  const nanoseconds came = one.now;
  one.now += milliseconds(9900);
  const auto hear = [&](const std::vector<std::byte>& octets) {
    pdu::CellRoles roles;
    pdu::GroupMap map;
    if (pdu::decode(octets, roles) == pdu::DecodeError::none)
      one.role.receive(roles, kElder, one.now);
    if (pdu::decode(octets, map) == pdu::DecodeError::none)
      one.role.receive(map, kElder, one.now, came);
  };
  std::for_each(said.begin(), said.end(), hear);
  EXPECT_EQ(one.role.group(kHere, one.now), GroupIndex{1});
  EXPECT_FALSE(one.role.group(kHere, came + seconds(10))) << "its lease is over";
}

TEST(LeaderRole, SendsNoMapAfterASuspension) {
  Side side(kElder, seconds(1000), kHere);
  side.run(seconds(3));
  side.now += seconds(20);
  const auto said = side.run(seconds(1));
  EXPECT_EQ(std::count_if(said.begin(), said.end(), is_map), 0);
}

}  // namespace
}  // namespace reckon::aoim
