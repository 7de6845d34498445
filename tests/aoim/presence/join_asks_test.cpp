// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/join_asks.hpp"

#include <gtest/gtest.h>

#include <map>

namespace reckon::aoim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr GroupIndex kAskedGroup{3}, kSecondGroup{4};
constexpr CellId kAskedCell{1, 2}, kSecondCell{2, 2};

std::uint64_t asked_utc(nanoseconds now) {
  return 1'000'000'000'000u + static_cast<std::uint64_t>(now.count());
}

// The cells of the requests that are due at `now`, each with the time that identifies its request.
std::map<CellId, std::uint64_t> asked(JoinAsks& asks, nanoseconds now, bool announcing = true) {
  std::map<CellId, std::uint64_t> cells;
  for (const JoinAsks::Question& question : asks.take_due(now, asked_utc(now), announcing))
    cells[question.cell] = question.since;
  return cells;
}

using Cells = std::map<CellId, std::uint64_t>;

TEST(JoinAsks, RepeatOnceWithTheSameTime) {
  JoinAsks asks(16);
  EXPECT_FALSE(asks.has_new());
  asks.join(kAskedGroup, kAskedCell, true, seconds(1));
  EXPECT_TRUE(asks.has_new());
  EXPECT_EQ(asked(asks, seconds(1), false), (Cells{{kAskedCell, asked_utc(seconds(1))}}));
  EXPECT_FALSE(asks.has_new());
  EXPECT_EQ(asks.next_repetition(), milliseconds(1600));
  asks.note_heard(kAskedGroup);
  EXPECT_EQ(asked(asks, milliseconds(1299)), Cells{}) << "others may still be about to answer";
  EXPECT_EQ(asked(asks, milliseconds(1600), false), Cells{}) << "only with an announcement";
  EXPECT_EQ(asked(asks, milliseconds(1600)), (Cells{{kAskedCell, asked_utc(seconds(1))}}));
  EXPECT_EQ(asks.next_repetition(), nanoseconds::max());
  EXPECT_EQ(asked(asks, seconds(3)), Cells{});
}

TEST(JoinAsks, AskSilentGroupsThreeTimesAtMost) {
  JoinAsks asks(16);
  asks.join(kAskedGroup, kAskedCell, true, seconds(1));
  asks.join(kSecondGroup, kSecondCell, true, seconds(1));
  EXPECT_EQ(asked(asks, seconds(1)).size(), 2U);
  asks.note_heard(kSecondGroup);
  for (const int second : {2, 3, 4}) {
    const Cells cells = asked(asks, seconds(second));
    EXPECT_EQ(cells.at(kAskedCell), asked_utc(seconds(second)));
    EXPECT_EQ(cells.count(kSecondCell), second == 2 ? 1U : 0U) << second;
  }
  EXPECT_EQ(asked(asks, seconds(5)), Cells{});
}

TEST(JoinAsks, StopForAnsweredAndLeftGroups) {
  JoinAsks asks(16);
  asks.join(kAskedGroup, kAskedCell, true, seconds(1));
  asks.join(kSecondGroup, kSecondCell, true, seconds(1));
  EXPECT_EQ(asked(asks, seconds(1)).size(), 2U);
  EXPECT_EQ(asked(asks, seconds(2)).size(), 2U);
  asks.note_heard(kAskedGroup);
  asks.leave(kSecondGroup);
  EXPECT_EQ(asked(asks, seconds(3)), Cells{});
}

TEST(JoinAsks, AtStartConcernOnlySilentGroups) {
  JoinAsks asks(16);
  asks.join(kAskedGroup, kAskedCell, false, seconds(1));
  asks.join(kSecondGroup, kSecondCell, false, seconds(1));
  EXPECT_FALSE(asks.has_new());
  EXPECT_EQ(asked(asks, seconds(1)), Cells{});
  asks.note_heard(kAskedGroup);
  EXPECT_EQ(asked(asks, seconds(2)), (Cells{{kSecondCell, asked_utc(seconds(2))}}));
}

TEST(JoinAsks, SplitManyCellsIntoDistinctRequests) {
  JoinAsks asks(300);
  for (std::uint16_t i = 1; i <= 300; ++i) asks.join({i}, {i, 0}, true, seconds(1));
  std::map<std::uint64_t, std::size_t> questions;
  for (const auto& [cell, since] : asked(asks, seconds(1))) ++questions[since];
  const std::uint64_t first = asked_utc(seconds(1));
  EXPECT_EQ(questions, (std::map<std::uint64_t, std::size_t>{
                           {first, 128}, {first + 1, 128}, {first + 2, 44}}));
}

// A program that steps the clock itself often makes several steps at one instant. Two requests with
// the same time would be one request to their receivers, and the second would have no answer.
TEST(JoinAsks, GiveRequestsOfOneInstantDistinctTimes) {
  JoinAsks asks(16);
  ReceivedAsks heard;
  asks.join(kAskedGroup, kAskedCell, true, seconds(1));
  static_cast<void>(asked(asks, seconds(1)));
  for (const int second : {2, 3, 4}) {  // each request is repeated at most three times
    EXPECT_TRUE(heard.note(11, asked(asks, seconds(second)).at(kAskedCell)));
    asks.join(kSecondGroup, kSecondCell, true, seconds(second));
    EXPECT_TRUE(heard.note(11, asked(asks, seconds(second), false).at(kSecondCell)));
    asks.leave(kSecondGroup);
  }
}

TEST(ReceivedAsks, IdentifyARequestBySenderAndTime) {
  ReceivedAsks heard;
  EXPECT_TRUE(heard.note(11, 5));
  EXPECT_FALSE(heard.note(11, 5));
  EXPECT_TRUE(heard.note(12, 5));
  EXPECT_TRUE(heard.note(11, 6));
  EXPECT_FALSE(heard.note(11, 5));
  EXPECT_TRUE(heard.note(11, 0));
  EXPECT_TRUE(heard.note(11, 0)) << "of no instant";
}

}  // namespace
}  // namespace reckon::aoim
