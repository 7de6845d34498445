// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "reckon/aoim/leader/group_directory.hpp"
#include "reckon/aoim/leader/group_pool.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr nanoseconds kQuarantine = seconds(30);

CellId cell(std::int32_t q) { return {q, 0}; }

TEST(GroupPool, GivesEachCellAGroupUntilExhausted) {
  GroupPool pool(3, kQuarantine);
  EXPECT_EQ(pool.take(cell(1), seconds(1)), GroupIndex{1});
  EXPECT_EQ(pool.take(cell(2), seconds(1)), GroupIndex{2});
  EXPECT_EQ(pool.take(cell(1), seconds(2)), GroupIndex{1}) << "it has one";
  EXPECT_EQ(pool.take(cell(3), seconds(1)), GroupIndex{3});
  EXPECT_FALSE(pool.take(cell(4), seconds(1)));
  EXPECT_THROW(GroupPool(0, kQuarantine), std::invalid_argument);
  EXPECT_THROW(GroupPool(1001, kQuarantine), std::invalid_argument);
}

TEST(GroupPool, ReusesTheLongestIdleGroupAfterQuarantine) {
  GroupPool pool(2, kQuarantine);
  pool.take(cell(1), seconds(0));
  pool.take(cell(2), seconds(0));
  pool.give_back(cell(2), seconds(10));
  pool.give_back(cell(1), seconds(11));
  EXPECT_FALSE(pool.take(cell(3), seconds(39)));
  EXPECT_EQ(pool.take(cell(3), seconds(50)), GroupIndex{2});
  EXPECT_EQ(pool.take(cell(4), seconds(50)), GroupIndex{1});
}

TEST(GroupPool, QuarantinesGroupsOfAnEarlierLeader) {
  GroupPool pool(3, kQuarantine);
  const std::vector<pdu::CellGroup> map{{1, 0, 0, 2, 0}};
  pool.begin(map, false, seconds(100));
  EXPECT_EQ(pool.take(cell(1), seconds(100)), GroupIndex{2});
  EXPECT_FALSE(pool.take(cell(5), seconds(129)));
  EXPECT_TRUE(pool.take(cell(5), seconds(130)));
  pool.begin(map, true, seconds(100));
  EXPECT_TRUE(pool.take(cell(5), seconds(100))) << "nobody led before";
}

TEST(GroupPool, WithdrawsAGroupThatTwoLeadersAssigned) {
  GroupPool pool(3, kQuarantine);
  pool.take(cell(1), seconds(0));  // group 1
  pool.take(cell(2), seconds(0));  // group 2
  const std::vector<pdu::CellGroup> theirs{{9, 0, 0, 1, 0}, {2, 0, 0, 2, 0}, {8, 0, 0, 3, 0}};
  pool.merge(theirs, seconds(5));
  EXPECT_EQ(pool.in_use(), 1U);
  EXPECT_EQ(pool.take(cell(2), seconds(6)), GroupIndex{2}) << "both say the same";
  EXPECT_FALSE(pool.take(cell(1), seconds(34)));
  EXPECT_TRUE(pool.take(cell(1), seconds(35)));
}

struct Map {
  explicit Map(std::vector<pdu::CellGroup> entries, std::uint32_t version = 1)
      : octets(entries.size() * 16) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      static_cast<void>(pdu::store_record(entries[i], std::span(octets).subspan(16 * i)));
    }
    pdu.version = version;
    pdu.parts = 1;
    pdu.pool = 8;
    pdu.groups = octets;
  }
  std::vector<std::byte> octets;
  pdu::GroupMap pdu;
};

TEST(GroupDirectory, KnowsGroupsAndBeaconsDuringTheLease) {
  GroupDirectory directory(8, seconds(10));
  EXPECT_TRUE(directory.receive(Map({{5, 0, 0xBEAC, 7, 0}, {-1, 0, 0, 2, 0}}).pdu, 3, seconds(1)));
  EXPECT_EQ(directory.group(cell(5), seconds(10)), GroupIndex{7});
  EXPECT_EQ(directory.group(cell(-1), seconds(10)), GroupIndex{2});
  EXPECT_FALSE(directory.group(cell(6), seconds(10)));
  EXPECT_EQ(directory.find_beacon(0xBEAC, seconds(10))->group, 7);
  EXPECT_FALSE(directory.find_beacon(0, seconds(10)));
  EXPECT_FALSE(directory.group(cell(5), seconds(11)));
  EXPECT_FALSE(directory.find_beacon(0xBEAC, seconds(11)));
}

TEST(GroupDirectory, AcceptsRowsForABeaconOnly) {
  GroupDirectory directory(8, seconds(10));
  const Map map({{5, 0, 11, 7, 0}, {5, 0, 12, 0, 0}, {6, 0, 13, 0, 0}});
  ASSERT_TRUE(directory.receive(map.pdu, 3, seconds(1)));
  EXPECT_EQ(directory.find_beacon(11, seconds(2))->group, 7);
  EXPECT_EQ(directory.find_beacon(12, seconds(2))->group, 7) << "that of its cell";
  EXPECT_EQ(directory.find_beacon(13, seconds(2))->column, 6);
  EXPECT_EQ(directory.find_beacon(13, seconds(2))->group, kBaseGroup.value);
  EXPECT_EQ(directory.entries().size(), 1U) << "cells that have a group";
  EXPECT_FALSE(directory.group(cell(6), seconds(2)));
}

TEST(GroupDirectory, WaitsForAllPartsOfOneVersion) {
  GroupDirectory directory(8, seconds(10));
  Map first({{1, 0, 0, 1, 0}}, 4), second({{2, 0, 0, 2, 0}}, 4), newer({{3, 0, 0, 3, 0}}, 5);
  first.pdu.parts = second.pdu.parts = 2;
  second.pdu.part = 1;
  EXPECT_FALSE(directory.receive(first.pdu, 3, seconds(1)));
  EXPECT_FALSE(directory.receive(first.pdu, 3, seconds(1))) << "a copy";
  EXPECT_FALSE(directory.group(cell(1), seconds(1)));
  EXPECT_TRUE(directory.receive(second.pdu, 3, seconds(1)));
  EXPECT_TRUE(directory.receive(newer.pdu, 3, seconds(2)));
  EXPECT_FALSE(directory.receive(first.pdu, 3, seconds(3))) << "overtaken";
  EXPECT_EQ(directory.entries().size(), 1U);
  EXPECT_TRUE(directory.receive(Map({{9, 0, 0, 9 - 1, 0}}, 2).pdu, 4, seconds(4)))
      << "another leader's, whatever its version";
}

TEST(GroupDirectory, RefusesMapsThatContradictThemselvesOrThePool) {
  const auto refuses = [](auto spoil) {
    GroupDirectory directory(8, seconds(10));
    Map map({{1, 0, 0, 1, 0}, {2, 0, 0, 2, 0}});
    spoil(map);
    EXPECT_FALSE(directory.receive(map.pdu, 3, seconds(1)));
    EXPECT_EQ(directory.refused(), 1U);
    EXPECT_TRUE(directory.entries().empty());
  };
  refuses([](Map& m) { m = Map({{1, 0, 0, 1, 0}, {2, 0, 0, 1, 0}}); });
  refuses([](Map& m) { m = Map({{1, 0, 0, 1, 0}, {1, 0, 0, 2, 0}}); });
  refuses([](Map& m) { m = Map({{1, 0, 0, 9, 0}}); });
  refuses([](Map& m) { m = Map({{1, 0, 0, 0, 0}}); });
  refuses([](Map& m) { m = Map({{1, 0, 9, 1, 0}, {2, 0, 9, 0, 0}}); });
  refuses([](Map& m) { m.pdu.pool = 9; });
  refuses([](Map& m) { m.pdu.parts = 0; });
  refuses([](Map& m) { m.pdu.parts = GroupDirectory::kMostParts + 1; });
  refuses([](Map& m) { m.pdu.part = 1; });
}

}  // namespace
}  // namespace reckon::aoim
