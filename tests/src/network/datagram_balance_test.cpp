// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/datagram_balance.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <random>
#include <set>

#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/peer/network/fan_out_link.hpp"
#include "reckon/peer/network/impaired_link.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tests/src/support/balance_fixture.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;
using balances::DatagramBalances;
using balances::event;
using balances::kLife;

TEST_F(DatagramBalances, CountAMissingNumberUntilItArrivesLate) {
  arrive({5, 6, 9, 10});
  arrive({7});
  const Stretch stretch = only_stretch();
  EXPECT_EQ(stretch.first, 5u);
  EXPECT_EQ(stretch.last, 10u);
  EXPECT_EQ(stretch.arrived, 5u);
  EXPECT_EQ(stretch.missing, 1u);
  EXPECT_EQ(stretch.copies, 0u);
}

TEST_F(DatagramBalances, BeginAStretchAtTheLeastNumberReceived) {
  arrive({20, 17});
  const Stretch stretch = only_stretch();
  EXPECT_EQ(stretch.first, 17u);
  EXPECT_EQ(stretch.arrived, 2u);
  EXPECT_EQ(stretch.missing, 2u);
}

TEST_F(DatagramBalances, CountACopyOnce) {
  arrive({1, 2, 2, 4, 3, 3, 1});
  const Stretch stretch = only_stretch();
  EXPECT_EQ(stretch.arrived, 4u);
  EXPECT_EQ(stretch.missing, 0u);
  EXPECT_EQ(stretch.copies, 3u);
}

// A group is left and joined again at once: datagrams of the two memberships are kept apart.
TEST_F(DatagramBalances, AssignAStretchToItsMembership) {
  const auto change = [this](DatagramFate fate, std::chrono::nanoseconds when) {
    DatagramEvent changed = event(fate, 0);
    changed.time = when;
    balance_.take(changed);
  };
  arrive({1});
  EXPECT_EQ(only_stretch().joined, std::chrono::nanoseconds(-1)) << "nothing is joined: a list";
  change(DatagramFate::joined, 3s);
  arrive({2, 3});
  change(DatagramFate::left, 7s);
  change(DatagramFate::joined, 7s + 1ms);
  arrive({9});
  const BalanceReport report = balance_.report(0s, true);
  ASSERT_EQ(report.stretches.size(), 2u);
  EXPECT_EQ(report.stretches[0].last, 3u);
  EXPECT_EQ(report.stretches[0].joined, 3s);
  EXPECT_EQ(report.stretches[1].first, 9u);
  EXPECT_EQ(report.stretches[1].joined, 7s + 1ms);
  ASSERT_FALSE(report.memberships.empty());
  EXPECT_EQ(report.memberships[0].joined, 3s);
}

TEST_F(DatagramBalances, GoOnWhereNumbersWrap) {
  arrive({0xfffffffeu, 1, 0xffffffffu});
  const Stretch stretch = only_stretch();
  EXPECT_EQ(stretch.last, 1u);
  EXPECT_EQ(stretch.arrived, 3u);
  EXPECT_EQ(stretch.missing, 1u);
}

TEST_F(DatagramBalances, AgreeWithTheSetsOfNumbersThatCame) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 dice(seed);
    std::set<std::uint32_t> came;
    std::uint64_t copies = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const auto number = static_cast<std::uint32_t>(5000 + i + dice() % 40 - dice() % 40);
      if (dice() % 10 == 0) continue;
      copies += came.insert(number).second ? 0 : 1;
      arrive({number});
    }
    const Stretch stretch = only_stretch();
    EXPECT_EQ(stretch.first, *came.begin()) << "seed " << seed;
    EXPECT_EQ(stretch.last, *came.rbegin()) << "seed " << seed;
    EXPECT_EQ(stretch.arrived, came.size()) << "seed " << seed;
    EXPECT_EQ(stretch.copies, copies) << "seed " << seed;
    EXPECT_EQ(stretch.arrived + stretch.missing, stretch.last - stretch.first + 1) << seed;
  }
}

TEST_F(DatagramBalances, EndAStretchWhereItsGroupIsLeft) {
  balance_.take(event(DatagramFate::joined));
  arrive({1, 2});
  balance_.take(event(DatagramFate::left));
  balance_.take(event(DatagramFate::joined));
  arrive({9});
  const BalanceReport report = balance_.report(0s, true);
  ASSERT_EQ(report.stretches.size(), 2u);
  EXPECT_EQ(report.stretches[0].last, 2u);
  EXPECT_EQ(report.stretches[1].first, 9u);
  EXPECT_EQ(report.stretches[1].missing, 0u);
  ASSERT_EQ(report.memberships.size(), 2u);
  EXPECT_LT(report.memberships[1].left, 0s);
}

TEST_F(DatagramBalances, ReportEachEventOnce) {
  arrive({1, 2, 3});
  std::uint64_t arrived = 0;
  for (const bool end : {false, true}) {
    const BalanceReport report = balance_.report(0s, end);
    for (const FateCounts& row : report.fates) arrived += of(row.counts, DatagramFate::arrived);
    EXPECT_EQ(report.stretches.size(), end ? 1u : 0u);
    if (!end) arrive({4});
  }
  EXPECT_EQ(arrived, 4u);
}

TEST_F(DatagramBalances, ForgetASenderAfterFiveMinutesOfSilence) {
  arrive({1, 2});
  EXPECT_TRUE(balance_.report(10s, false).stretches.empty());
  EXPECT_TRUE(balance_.report(200s, false).stretches.empty());
  EXPECT_EQ(balance_.report(310s, false).stretches.size(), 1u);
  EXPECT_TRUE(balance_.report(310s, true).stretches.empty());
}

// The tracker accepts a number that is far ahead when a second one agrees.
TEST_F(DatagramBalances, FollowTheLossesOfTheTracker) {
  aoim::SequenceTracker tracker;
  for (const std::uint32_t number : {3u, 4u, 8u, 6u, 900u, 901u, 903u, 1300u}) {
    const std::uint64_t before = tracker.counts().lost;
    DatagramEvent heard = event(DatagramFate::delivered, number);
    heard.verdict = tracker.note(kLife, aoim::GroupIndex{1}, number);
    heard.lost = static_cast<std::int32_t>(tracker.counts().lost - before);
    balance_.take(heard);
  }
  const BalanceReport report = balance_.report(0s, true);
  ASSERT_EQ(report.tracked.size(), 1u);
  const TrackedStretch& stretch = report.tracked.front();
  EXPECT_EQ(stretch.first, 3u);
  EXPECT_EQ(stretch.last, 903u);
  EXPECT_EQ(stretch.received, 7u);
  EXPECT_EQ(static_cast<std::uint64_t>(stretch.lost), tracker.counts().lost);
  EXPECT_EQ(static_cast<std::int64_t>(stretch.received) + stretch.lost, 903 - 3 + 1);
}

TEST_F(DatagramBalances, CountMissedEvents) {
  DatagramTap small(4);
  DatagramBalance balance(small);
  for (int i = 0; i < 6; ++i) small.push(DatagramTap::Loop::read, event(DatagramFate::arrived, 1));
  balance.look();
  EXPECT_EQ(balance.report(0s, true).missed, 2u);
}

}  // namespace
}  // namespace reckon::peer
