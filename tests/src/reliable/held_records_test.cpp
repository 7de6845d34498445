// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records that wait for an earlier one: bounds of their number and time.
#include "reckon/peer/reliable/held_records.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "reckon/peer/reliable/received_set.hpp"

namespace reckon::test {
namespace {

using peer::HeldRecord;
using peer::HeldRecords;

constexpr std::array<std::byte, 3> kOctets{std::byte{1}, std::byte{2}, std::byte{3}};

TEST(HeldRecords, AreBoundedForEachSenderAndInAll) {
  HeldRecords held;
  std::size_t kept = 0;
  for (std::uint32_t epoch = 1; epoch <= 5; ++epoch) {
    for (std::uint32_t i = 0; i < 200; ++i)
      kept += held.hold({epoch, i, i - 1, kOctets}, {}) < HeldRecords::kMost ? 1 : 0;
    EXPECT_EQ(kept, std::min<std::size_t>(128 * epoch, 512));
  }
  held.drop(2);
  EXPECT_LT(held.hold({5, 1, 0, kOctets}, {}), HeldRecords::kMost);
}

TEST(HeldRecords, AreReleasedByPredecessorOrAge) {
  HeldRecords held;
  held.hold({1, 10, 8, kOctets}, std::chrono::seconds(1));
  held.hold({1, 11, 10, kOctets}, std::chrono::seconds(1));
  EXPECT_EQ(held.hold({1, 10, 9, kOctets}, std::chrono::seconds(2)),
            held.hold({1, 10, 9, kOctets}, std::chrono::seconds(2)))
      << "the same record";
  HeldRecord out;
  const auto after = [](std::uint32_t before) {
    return [before](const HeldRecord& record) { return record.predecessor == before; };
  };
  EXPECT_EQ(held.take(after(8), out), HeldRecords::kMost) << "it waits for another one now";
  EXPECT_LT(held.take(after(9), out), HeldRecords::kMost);
  EXPECT_EQ(out.sequence, 10u);
  EXPECT_TRUE(std::ranges::equal(out.octets, kOctets));
  held.expire(std::chrono::seconds(6));
  EXPECT_FALSE(held.empty());
  held.expire(std::chrono::seconds(7));
  EXPECT_TRUE(held.empty());
}

TEST(ReceivedSet, DoesNotWaitForRecordsOfOthers) {
  peer::ReceivedSet set(4);
  EXPECT_FALSE(set.needs_no_wait(1, 10)) << "nothing is known of the sender";
  static_cast<void>(set.take(1, 10, {}));
  set.follow(1, 12, {});
  EXPECT_TRUE(set.needs_no_wait(1, 10));
  EXPECT_FALSE(set.needs_no_wait(1, 11));
  EXPECT_TRUE(set.needs_no_wait(1, 12)) << "it is for others";
  EXPECT_FALSE(set.needs_no_wait(1, 13));
  set.follow(1, 11 + peer::ReceivedSet::kWindow, {});
  EXPECT_TRUE(set.needs_no_wait(1, 11)) << "given up";
}

}  // namespace
}  // namespace reckon::test
