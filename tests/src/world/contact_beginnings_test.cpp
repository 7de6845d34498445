// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/contact_beginnings.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace reckon::peer {
namespace {

aoim::SourceAddress owner_at(std::uint8_t host, std::uint64_t boot = 0) {
  aoim::SourceAddress from;
  from.octets[15] = host;
  from.port = 3000;
  from.boot = boot;
  return from;
}

// Rows with their owners, as in a table.
class Beginnings : public testing::Test {
 protected:
  std::size_t appear(const pdu::EntityId& id, const aoim::SourceAddress& from) {
    RemoteEntity row;
    row.id = id;
    rows_.push_back(row);
    EXPECT_TRUE(owners_.push(from, false, now_));
    beginnings_.add_row();
    return rows_.size() - 1;
  }
  bool presses(std::size_t place, double depth, std::size_t hand = 0) {
    return beginnings_.may_press(place, rows_[place], hand, depth, owners_, now_);
  }

  std::vector<RemoteEntity> rows_;
  RowOwners owners_{100};
  ContactBeginnings beginnings_{100};
  std::chrono::nanoseconds now_ = std::chrono::seconds(100);
};

TEST_F(Beginnings, HoldABodyBackThatAppearsInside) {
  const std::size_t inside = appear({1, 2, 3}, owner_at(7));
  EXPECT_FALSE(presses(inside, 0.01));
  EXPECT_FALSE(presses(inside, 1e-9));
  EXPECT_EQ(beginnings_.held_back(), 2u);
  EXPECT_EQ(beginnings_.last_held_back(), (pdu::EntityId{1, 2, 3}));
  EXPECT_TRUE(presses(inside, 0.0));
  EXPECT_TRUE(presses(inside, 0.01)) << "it was outside";
}

TEST_F(Beginnings, AdmitABodyThatAppearsOutside) {
  const std::size_t outside = appear({1, 2, 3}, owner_at(7));
  EXPECT_TRUE(presses(outside, -1.0));
  EXPECT_TRUE(presses(outside, 0.01));
  EXPECT_FALSE(presses(outside, 0.01, 1)) << "the other hand never was outside";
}

TEST_F(Beginnings, RememberAPressedPeerFor12Seconds) {
  const std::size_t first = appear({1, 2, 3}, owner_at(7));
  EXPECT_TRUE(presses(first, -0.1) && presses(first, 0.01));
  now_ += std::chrono::milliseconds(11'900);
  EXPECT_FALSE(presses(appear({1, 2, 4}, owner_at(8)), 0.01)) << "another address";
  EXPECT_FALSE(presses(appear({1, 3, 4}, owner_at(7)), 0.01)) << "another number";
  EXPECT_TRUE(presses(appear({1, 2, 4}, owner_at(7)), 0.01)) << "it was restarted";
  now_ += std::chrono::milliseconds(12'100);
  EXPECT_FALSE(presses(appear({1, 2, 5}, owner_at(7)), 0.01));
}

TEST_F(Beginnings, RememberAMemberAtAnyAddress) {
  const std::size_t first = appear({1, 2, 3}, owner_at(7, 11));
  EXPECT_TRUE(presses(first, -0.1) && presses(first, 0.01));
  EXPECT_TRUE(presses(appear({1, 2, 4}, owner_at(8, 12)), 0.01));
}

TEST_F(Beginnings, HoldBackOwnersThatWereHeldBack) {
  EXPECT_FALSE(presses(appear({1, 2, 3}, owner_at(7)), 0.01));
  EXPECT_FALSE(presses(appear({1, 2, 4}, owner_at(7)), 0.01)) << "it was never pressed";
}

TEST_F(Beginnings, ForgetThePeerPressedLongestAgo) {
  for (std::uint16_t i = 0; i <= ContactBeginnings::kPeers; ++i) {
    const std::size_t place = appear({1, static_cast<std::uint16_t>(i + 1), 1}, owner_at(7));
    EXPECT_TRUE(presses(place, -0.1) && presses(place, 0.01));
    now_ += std::chrono::milliseconds(1);
  }
  EXPECT_FALSE(presses(appear({1, 1, 9}, owner_at(7)), 0.01));
  EXPECT_TRUE(presses(appear({1, 2, 9}, owner_at(7)), 0.01));
}

TEST_F(Beginnings, FollowTheRowsOfTheTable) {
  const std::size_t first = appear({1, 2, 3}, owner_at(7)), last = appear({1, 9, 3}, owner_at(8));
  EXPECT_TRUE(presses(last, -0.1));
  beginnings_.erase_row(first);
  owners_.erase(first);
  rows_[first] = rows_[last];
  EXPECT_TRUE(presses(first, 0.01)) << "the last row has taken its place";
}

}  // namespace
}  // namespace reckon::peer
