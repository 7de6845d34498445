// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "reckon/peer/reliable/acknowledged_set.hpp"
#include "reckon/peer/reliable/received_set.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

struct Reported final : AssuredReports {
  void settle(const AssuredReport& report) noexcept override { all.push_back(report); }
  std::vector<AssuredReport> all;
};

const std::vector<std::byte> kOctets(64, std::byte{0x5A});
const std::vector<std::uint32_t> kThree{11, 22, 33};

pdu::AssuredReceipt receipt_of(std::initializer_list<std::uint32_t> back) {
  pdu::AssuredReceipt receipt;
  for (const std::uint32_t bit : back)
    receipt.received[bit / 8] = static_cast<std::uint8_t>(receipt.received[bit / 8] | 1 << bit % 8);
  return receipt;
}

DueReceipt due_of(ReceivedSet& set) {
  DueReceipt due;
  EXPECT_TRUE(set.take_receipt(due));
  return due;
}

TEST(AcknowledgedSet, RepeatsOnItsScheduleUntilItGivesUp) {
  AcknowledgedSet set(8);
  Reported reported;
  ASSERT_EQ(set.add({.octets = kOctets, .tag = 7}, kThree, seconds(1)), 1U);
  std::vector<std::int64_t> times;
  std::vector<bool> to_hosts;
  for (nanoseconds now = seconds(1); set.in_flight() > 0; now = set.next_step()) {
    set.give_up(now, reported);
    for (DueRecord due; set.take_due(now, due);) {
      EXPECT_EQ(due.is_first, times.empty());
      EXPECT_TRUE(std::ranges::equal(due.content.octets, kOctets));
      EXPECT_EQ(due.missing.size(), 3U);
      times.push_back((now - seconds(1)) / milliseconds(1));
      to_hosts.push_back(due.is_for_hosts);
    }
  }
  std::vector<std::int64_t> wanted{0, 3, 6, 12, 24, 48, 96, 192};
  while (wanted.back() + 200 < 5000) wanted.push_back(wanted.back() + 200);
  EXPECT_EQ(times, wanted);
  EXPECT_EQ(std::ranges::find(to_hosts, true) - to_hosts.begin(), 8) << "from 392 ms on";
  ASSERT_EQ(reported.all.size(), 3U);
  for (const AssuredReport& report : reported.all) {
    EXPECT_EQ(report.outcome, AssuredOutcome::gave_up);
    EXPECT_EQ(report.tag, 7U);
  }
  EXPECT_TRUE(reported.all.back().is_last && !reported.all.front().is_last);
  EXPECT_EQ(set.next_step(), nanoseconds::max());
}

TEST(AcknowledgedSet, AddressesOnlyThoseThatLackARecord) {
  AcknowledgedSet set(3);
  Reported reported;
  ASSERT_TRUE(set.add({.octets = kOctets}, kThree, seconds(0)));
  DueRecord due;
  ASSERT_TRUE(set.take_due(seconds(0), due));
  set.acknowledge(22, 1, receipt_of({0}), reported);
  ASSERT_TRUE(set.take_due(milliseconds(3), due));
  EXPECT_EQ(std::vector(due.missing.begin(), due.missing.end()),
            (std::vector<std::uint32_t>{11, 33}));
  set.drop(33, reported);
  pdu::AssuredReceipt refused = receipt_of({0});
  refused.refused = refused.received;
  set.acknowledge(11, 1, refused, reported);
  EXPECT_FALSE(set.take_due(milliseconds(6), due));
  ASSERT_EQ(reported.all.size(), 3U);
  EXPECT_EQ(reported.all[0].outcome, AssuredOutcome::accepted);
  EXPECT_EQ(reported.all[1].outcome, AssuredOutcome::left);
  EXPECT_EQ(reported.all[2].outcome, AssuredOutcome::refused);
  EXPECT_EQ(reported.all[2].peer, 11U);
}

TEST(AcknowledgedSet, RefusesMoreThanAWindowInFlight) {
  AcknowledgedSet set(3, 0xFFFFFF80U);
  Reported reported;
  for (std::size_t i = 0; i < AcknowledgedSet::kMostInFlight; ++i)
    ASSERT_TRUE(set.add({.octets = kOctets}, kThree, seconds(0))) << i;
  EXPECT_FALSE(set.add({.octets = kOctets}, kThree, seconds(0)));
  set.acknowledge(11, 0x7F, receipt_of({255}), reported);
  set.acknowledge(22, 0x7F, receipt_of({255}), reported);
  EXPECT_FALSE(set.add({.octets = kOctets}, kThree, seconds(0)));
  set.acknowledge(33, 0x7F, receipt_of({255}), reported);
  EXPECT_EQ(set.add({.octets = kOctets}, kThree, seconds(0)), 0x80U) << "the first is done";
  EXPECT_FALSE(set.add({.octets = kOctets}, kThree, seconds(0)));
}

TEST(AcknowledgedSet, RefusesLongRecordsAndTooManyAddressees) {
  AcknowledgedSet set(3);
  const std::vector<std::byte> octets(pdu::kMostAssured + 1);
  EXPECT_FALSE(set.add({.octets = octets}, kThree, seconds(0)));
  EXPECT_FALSE(set.add({.octets = kOctets}, {}, seconds(0)));
  EXPECT_TRUE(set.add({.octets = std::span(octets).first(1200)}, kThree, seconds(0)));
  EXPECT_FALSE(set.add({.octets = kOctets}, std::vector<std::uint32_t>{11, 44}, seconds(0)));
  EXPECT_EQ(set.in_flight(), 1U);
}

TEST(AcknowledgedSet, IgnoresReceiptsOfUnsentRecordsAndStrangers) {
  AcknowledgedSet set(3);
  Reported reported;
  ASSERT_TRUE(set.add({.octets = kOctets}, kThree, seconds(0)));
  pdu::AssuredReceipt all;
  all.received.fill(0xFF);
  set.acknowledge(11, 2, all, reported);
  set.acknowledge(11, 1000, all, reported);
  set.acknowledge(11, 0, all, reported);
  set.acknowledge(44, 1, all, reported);
  EXPECT_TRUE(reported.all.empty());
  set.acknowledge(11, 1, all, reported);
  EXPECT_EQ(reported.all.size(), 1U);
}

TEST(ReceivedSet, TakesEachRecordOnceOverTheWrap) {
  ReceivedSet set(2);
  constexpr std::uint32_t kFirst = 0xFFFFFFC0U;
  for (std::uint32_t i = 0; i < 600; i += 2) {
    EXPECT_EQ(set.take(5, kFirst + i + 1, seconds(0)), AssuredNovelty::fresh);
    EXPECT_EQ(set.take(5, kFirst + i, seconds(0)), AssuredNovelty::fresh) << "overtaken";
    EXPECT_EQ(set.take(5, kFirst + i + 1, seconds(0)), AssuredNovelty::duplicate);
  }
  EXPECT_EQ(set.take(5, kFirst, seconds(0)), AssuredNovelty::refused) << "too old";
  EXPECT_EQ(set.take(6, 9, seconds(0)), AssuredNovelty::fresh) << "another sender";
  EXPECT_EQ(set.take(7, 9, seconds(0)), AssuredNovelty::refused) << "no room";
  set.drop(5);
  EXPECT_EQ(set.take(7, 9, seconds(0)), AssuredNovelty::fresh);
  EXPECT_EQ(set.take(6, 9, seconds(0)), AssuredNovelty::duplicate);
}

TEST(ReceivedSet, ReceiptRepeatsTheWholeWindow) {
  ReceivedSet set(1);
  set.owe(5, false);
  EXPECT_FALSE(set.owes());
  for (std::uint32_t sequence = 1; sequence <= 300; ++sequence) {
    if (sequence % 7 != 0) static_cast<void>(set.take(5, sequence, seconds(0)));
    if (sequence % 5 == 0) set.refuse(5, sequence);
  }
  set.owe(5, false);
  set.owe(5, true);
  const DueReceipt due = due_of(set);
  EXPECT_FALSE(set.owes());
  EXPECT_EQ(due.epoch, 5U);
  EXPECT_EQ(due.highest, 300U);
  EXPECT_TRUE(due.is_for_host);
  for (std::uint32_t back = 0; back < 256; ++back) {
    const std::uint32_t sequence = 300 - back;
    const bool took = sequence % 7 != 0;
    EXPECT_EQ(due.receipt.received[back / 8] >> back % 8 & 1, took ? 1 : 0) << sequence;
    EXPECT_EQ(due.receipt.refused[back / 8] >> back % 8 & 1, took && sequence % 5 == 0 ? 1 : 0);
  }
}

TEST(ReceivedSet, ForgedFarNumbersDoNotMoveTheWindow) {
  ReceivedSet set(1);
  ASSERT_EQ(set.take(5, 100, seconds(0)), AssuredNovelty::fresh);
  for (const std::uint32_t far : {357U, 1'000'000U, 0x80000063U, 0x80000065U, 0xFFFFFF00U}) {
    EXPECT_EQ(set.take(5, far, seconds(1)), AssuredNovelty::refused) << far;
    EXPECT_EQ(set.take(5, far, seconds(1)), AssuredNovelty::refused) << far;
  }
  EXPECT_EQ(set.take(5, 356, seconds(2)), AssuredNovelty::fresh) << "256 ahead";
  EXPECT_EQ(set.take(5, 101, seconds(2)), AssuredNovelty::fresh);
  EXPECT_EQ(set.take(5, 100, seconds(2)), AssuredNovelty::refused);
}

TEST(ReceivedSet, IdleWindowFollowsTwoRecordsThatAgree) {
  ReceivedSet set(1);
  ASSERT_EQ(set.take(5, 100, seconds(0)), AssuredNovelty::fresh);
  EXPECT_EQ(set.take(5, 90'000, seconds(6)), AssuredNovelty::refused);
  EXPECT_EQ(set.take(5, 40'000, seconds(6)), AssuredNovelty::refused) << "they do not agree";
  EXPECT_EQ(set.take(5, 40'001, seconds(6)), AssuredNovelty::fresh);
  EXPECT_EQ(set.take(5, 40'000, seconds(6)), AssuredNovelty::fresh);
  EXPECT_EQ(set.take(5, 40'001, seconds(6)), AssuredNovelty::duplicate);
}

TEST(ReceivedSet, WindowFollowsRecordsForOthers) {
  ReceivedSet set(1);
  ASSERT_EQ(set.take(5, 100, seconds(0)), AssuredNovelty::fresh);
  for (std::uint32_t sequence = 101; sequence < 2000; sequence += 90)
    set.follow(5, sequence, seconds(0));
  EXPECT_EQ(set.take(5, 2000, seconds(0)), AssuredNovelty::fresh);
  EXPECT_EQ(set.take(5, 1990, seconds(0)), AssuredNovelty::fresh);
}

TEST(AssuredSets, AllocateNothingAfterConstruction) {
  AcknowledgedSet sent(1000);
  ReceivedSet received(1000);
  std::vector<std::uint32_t> all(1000);
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = 77 * i + 1;
  struct Count final : AssuredReports {
    void settle(const AssuredReport&) noexcept override { ++count; }
    std::size_t count = 0;
  } counted;
  pdu::AssuredReceipt receipt;
  receipt.received.fill(0xFF);
  const test::AllocationGuard guard;
  DueRecord due;
  DueReceipt owed;
  for (std::uint32_t round = 0; round < 300; ++round) {
    const auto sequence = sent.add({.octets = kOctets}, all, milliseconds(round));
    ASSERT_TRUE(sequence);
    while (sent.take_due(milliseconds(round), due)) continue;
    for (const std::uint32_t peer : all) {
      static_cast<void>(received.take(peer, *sequence, milliseconds(round)));
      received.owe(peer, false);
      sent.acknowledge(peer, *sequence, receipt, counted);
    }
    while (received.take_receipt(owed)) continue;
    if (round % 50 == 0) received.drop(all[round]);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(counted.count, 300'000U);
}

}  // namespace
}  // namespace reckon::peer
