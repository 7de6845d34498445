// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owners of rows, and whose row is replaced in a full table.
#include "reckon/peer/world/row_owners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using aoim::SourceAddress;
using std::chrono::nanoseconds;
using std::chrono::seconds;

SourceAddress v4(std::uint8_t host, std::uint16_t port) {
  return {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, host}, port};
}

// Adds a row of `to` as the table does: if full, another owner's row is replaced. Returns false if
// none can be.
bool add(RowOwners& owners, std::vector<SourceAddress>& rows, std::size_t capacity,
         const SourceAddress& to, bool guest) {
  if (rows.size() == capacity) {
    const auto place = owners.row_to_give_up(to, guest);
    if (!place) return false;
    owners.erase(*place);
    rows[*place] = rows.back();
    rows.pop_back();
  }
  if (!owners.push(to, guest, nanoseconds(0))) return false;
  rows.push_back(to);
  return true;
}

std::size_t count(const std::vector<SourceAddress>& rows, const SourceAddress& of) {
  return static_cast<std::size_t>(std::count(rows.begin(), rows.end(), of));
}

// Compared with a map, while rows are added, removed and change owners.
TEST(RowOwners, KnowsTheOwnerOfEachRow) {
  RowOwners owners(300);
  std::vector<SourceAddress> rows;
  std::map<SourceAddress, nanoseconds> heard;
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    SourceAddress from =
        v4(static_cast<std::uint8_t>(random() % 4), static_cast<std::uint16_t>(1 + random() % 40));
    if (random() % 2 == 0) from.octets[0] = 0xFE;  // an IPv6 address
    const nanoseconds now = seconds(i);
    const bool known = count(rows, from) > 0;
    if (rows.size() < 300 && random() % 2 == 0) {
      ASSERT_TRUE(owners.push(from, false, now));
      rows.push_back(from);
      if (!known) heard[from] = now;
    } else if (!rows.empty() && random() % 2 == 0) {
      const std::size_t place = random() % rows.size();
      owners.erase(place);
      rows[place] = rows.back();
      rows.pop_back();
    } else if (!rows.empty()) {
      const std::size_t place = random() % rows.size();
      ASSERT_TRUE(owners.hand_over(place, from, now));
      if (!known) heard[from] = now;
      rows[place] = from;
    }
    const SourceAddress other = v4(1, static_cast<std::uint16_t>(1 + random() % 40));
    owners.heard(other, now);
    heard[other] = now;
    for (std::size_t k = 0; k < rows.size(); k += 7) {
      ASSERT_EQ(owners.owner(k), rows[k]);
      ASSERT_EQ(owners.last_heard(k), heard[rows[k]]);
    }
  }
}

TEST(RowOwners, KnowSealedSendersByTheirBoot) {
  RowOwners owners(10);
  SourceAddress before = v4(1, 3000), after = v4(2, 3001);
  before.boot = after.boot = 77;
  ASSERT_TRUE(owners.push(before, false, seconds(1)));
  owners.heard(after, seconds(2));
  EXPECT_EQ(owners.last_heard(0), seconds(2));
  EXPECT_EQ(owners.owner(0).octets, after.octets) << "told with its address of now";
  SourceAddress other = v4(1, 3000);
  other.boot = 78;
  owners.heard(other, seconds(3));
  EXPECT_EQ(owners.last_heard(0), seconds(2));
}

TEST(RowOwners, OneHostThatInventsEntitiesShutsNobodyOut) {
  constexpr std::size_t kRows = 1000;
  RowOwners owners(kRows);
  std::vector<SourceAddress> rows;
  // From any number of ports.
  std::size_t taken = 0;
  for (std::uint16_t i = 0; i < 2 * kRows; ++i) {
    if (add(owners, rows, kRows, v4(9, static_cast<std::uint16_t>(1 + i % 50)), true)) ++taken;
  }
  EXPECT_EQ(taken, kRows);  // it does not replace its own rows
  for (std::size_t i = 0; i < kRows / 2; ++i)
    ASSERT_TRUE(add(owners, rows, kRows, v4(1, 3000), true)) << i;
  EXPECT_EQ(count(rows, v4(1, 3000)), kRows / 2);
  // Now neither host has too many rows.
  EXPECT_FALSE(add(owners, rows, kRows, v4(2, 3000), true));
  EXPECT_FALSE(add(owners, rows, kRows, v4(9, 1), true));
}

TEST(RowOwners, GuestsMakeRoomForPeersOnly) {
  constexpr std::size_t kRows = 100;
  RowOwners owners(kRows);
  std::vector<SourceAddress> rows;
  for (std::size_t i = 0; i < 60; ++i) ASSERT_TRUE(add(owners, rows, kRows, v4(1, 3000), false));
  for (std::size_t i = 0; i < 40; ++i)
    ASSERT_TRUE(add(owners, rows, kRows, v4(static_cast<std::uint8_t>(100 + i), 3000), true));
  EXPECT_FALSE(add(owners, rows, kRows, v4(99, 3000), true));
  for (std::size_t i = 0; i < 40; ++i) ASSERT_TRUE(add(owners, rows, kRows, v4(2, 3000), false));
  EXPECT_EQ(count(rows, v4(1, 3000)), 60U);
  EXPECT_EQ(count(rows, v4(2, 3000)), 40U);
  // A third peer's row replaces one of the host with more than half.
  EXPECT_TRUE(add(owners, rows, kRows, v4(3, 3000), false));
  EXPECT_EQ(count(rows, v4(1, 3000)), 59U);
}

TEST(RowOwners, OneHostTakesAtMostHalfTheSenders) {
  RowOwners owners(10000);
  std::size_t taken = 0;
  for (std::uint16_t port = 1; port <= 5000; ++port) {
    if (owners.push(v4(9, port), true, nanoseconds(0))) ++taken;
  }
  EXPECT_EQ(taken, RowOwners::kSenders / 2);
  EXPECT_TRUE(owners.push(v4(1, 1), true, nanoseconds(0)));
}

TEST(RowOwners, AllocateNothing) {
  RowOwners owners(2000);
  const test::AllocationGuard guard;
  for (std::uint16_t i = 0; i < 1000; ++i)
    static_cast<void>(owners.push(v4(static_cast<std::uint8_t>(i % 200), i), true, nanoseconds(i)));
  while (const auto place = owners.row_to_give_up(v4(250, 1), false)) {
    owners.erase(*place);
    if (*place == 0) break;
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace reckon::peer
