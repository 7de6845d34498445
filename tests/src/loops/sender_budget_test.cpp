// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/sender_budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace reckon::peer {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

IpEndpoint sender(std::uint32_t host, std::uint16_t port) {
  return IpEndpoint::v4(0x0a4d0000u + host, port);
}

class Budget : public testing::Test {
 protected:
  // Sends `rate` datagrams a second from one sender for `length`; returns how many were admitted.
  std::size_t send(const IpEndpoint& who, unsigned rate, nanoseconds length, bool pressed = false) {
    const nanoseconds gap = nanoseconds(seconds(1)) / rate, end = now_ + length;
    std::size_t admitted = 0;
    for (; now_ < end; now_ += gap) admitted += budget_.admit(who, now_, pressed) ? 1 : 0;
    return admitted;
  }
  std::vector<MutedSender> told() {
    std::vector<MutedSender> result;
    for (; told_.front() != nullptr; told_.pop()) result.push_back(*told_.front());
    return result;
  }

  void know(std::vector<IpEndpoint> members) {
    std::ranges::sort(members);
    KnownSources known;
    known.count = members.size();
    std::ranges::copy(members, known.sources.begin());
    budget_.know(known);
  }

  haptics::SpscRing<MutedSender> told_{1024};
  SenderBudget budget_{told_};
  nanoseconds now_ = seconds(100);
};

TEST_F(Budget, LetsAnIntroductionOfTenThousandEntitiesThrough) {
  EXPECT_GE(send(sender(1, 3000), 15'000, seconds(5)), 75'000u);
  EXPECT_GE(send(sender(1, 3000), 15'000, seconds(5), true), 75'000u);
  EXPECT_TRUE(told().empty());
}

TEST_F(Budget, MutesAFloodUntilItsEnd) {
  const std::size_t admitted = send(sender(1, 4000), 100'000, seconds(2));
  EXPECT_LE(admitted, SenderBudget::kMost);
  EXPECT_EQ(budget_.muted(), 1u);
  auto events = told();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].who, sender(1, 4000));
  EXPECT_TRUE(events[0].muted);

  send(sender(1, 4000), 100, seconds(1));
  events = told();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_FALSE(events[0].muted);
  EXPECT_GE(events[0].dropped, 200'000u - SenderBudget::kMost);
  EXPECT_EQ(budget_.muted(), 0u);
  EXPECT_EQ(send(sender(1, 4000), 1000, seconds(1)), 1000u);
}

TEST_F(Budget, ForgivesAFloodThatFallsSilent) {
  send(sender(1, 4000), 100'000, seconds(1));
  ASSERT_EQ(told().size(), 1u);
  budget_.look(now_ + milliseconds(50));
  EXPECT_TRUE(told().empty());
  budget_.look(now_ + milliseconds(350));
  const auto events = told();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_FALSE(events[0].muted);
}

TEST_F(Budget, AdmitsOtherHostsAndPortsDuringAFlood) {
  std::size_t honest = 0, beside = 0;
  for (int i = 0; i < 200'000; ++i, now_ += microseconds(10)) {
    static_cast<void>(budget_.admit(sender(1, 4000), now_, false));
    if (i % 100 == 0) honest += budget_.admit(sender(2, 3000), now_, false) ? 1 : 0;
    if (i % 100 == 50) beside += budget_.admit(sender(1, 3000), now_, false) ? 1 : 0;
  }
  EXPECT_EQ(honest, 2000u);
  EXPECT_EQ(beside, 2000u);
}

TEST_F(Budget, MutesAnAddressThatFloodsFromManyPorts) {
  std::size_t admitted = 0;
  for (int i = 0; i < 200'000; ++i, now_ += microseconds(10)) {
    const auto port = static_cast<std::uint16_t>(5000 + i % 50);
    admitted += budget_.admit(sender(1, port), now_, false) ? 1 : 0;
  }
  EXPECT_LE(admitted, SenderBudget::kMostOfAddress);
  bool all = false;
  for (const MutedSender& event : told()) all |= event.muted && event.who == sender(1, 0);
  EXPECT_TRUE(all) << "it is told by its address";
}

// A member sends `slow` datagrams a second. Beside it `floods` processes send 19,000 a second each,
// none of them too many by itself. The share of the member's datagrams that must be admitted, in
// per cent.
struct LocalFlood {
  unsigned floods;
  std::int64_t slow;
};

class BudgetOfAHost : public Budget, public testing::WithParamInterface<LocalFlood> {};

TEST_P(BudgetOfAHost, AdmitsAMemberBesideFloodsOfItsHost) {
  const IpEndpoint member = sender(1, 3000);
  know({sender(2, 3000), member});
  const auto slow = nanoseconds(seconds(1)) / GetParam().slow;
  const auto flood = nanoseconds(seconds(1)) / (19'000 * GetParam().floods);
  const nanoseconds end = now_ + seconds(3);
  std::size_t said = 0, heard = 0, strange = 0, strange_said = 0;
  nanoseconds next = now_;
  for (; now_ < end; now_ += flood) {
    const auto port = static_cast<std::uint16_t>(5000 + strange_said++ % GetParam().floods);
    strange += budget_.admit(sender(1, port), now_, true) ? 1 : 0;
    if (now_ < next) continue;
    next += slow;
    ++said;
    heard += budget_.admit(member, now_, true) ? 1 : 0;
  }
  EXPECT_EQ(heard, said);
  EXPECT_LE(strange, 3u * SenderBudget::kMostOfAddressPressed) << "the host is muted all the same";
}

INSTANTIATE_TEST_SUITE_P(Rates, BudgetOfAHost,
                         testing::Values(LocalFlood{5, 20}, LocalFlood{6, 100}, LocalFlood{17, 1000},
                                         LocalFlood{60, 5000}));

// A host that joins with many processes which all flood gets no more than the share of one host.
TEST_F(Budget, MembersOfOneHostShareItsLimit) {
  constexpr unsigned kMembers = 200;
  std::vector<IpEndpoint> members;
  for (unsigned i = 0; i < kMembers; ++i)
    members.push_back(sender(1, static_cast<std::uint16_t>(5000 + i)));
  know(members);
  std::size_t admitted = 0;
  const nanoseconds end = now_ + seconds(2);
  for (std::size_t i = 0; now_ < end; ++i, now_ += microseconds(2))
    admitted += budget_.admit(members[i % kMembers], now_, false) ? 1 : 0;
  EXPECT_LE(admitted, 21u * SenderBudget::kMostOfAddress + SenderBudget::kMostOfAddress);
}

TEST_F(Budget, MutesFloodingMembersAndForgetsDepartedOnes) {
  know({sender(1, 3000)});
  EXPECT_LE(send(sender(1, 3000), 100'000, seconds(1)), SenderBudget::kMost);
  EXPECT_EQ(budget_.muted(), 1u);
  know({});
  EXPECT_EQ(budget_.muted(), 0u);
  ASSERT_EQ(told().size(), 2u) << "muted, and read again";
  send(sender(1, 4000), 19'000, milliseconds(1));
  for (int i = 0; i < 100'000; ++i, now_ += microseconds(10))
    static_cast<void>(
        budget_.admit(sender(1, static_cast<std::uint16_t>(5000 + i % 6)), now_, false));
  EXPECT_FALSE(budget_.admit(sender(1, 3000), now_, false));
}

// A source keeps its count when its table entry was reused, and when it was muted before it became
// a member.
TEST_F(Budget, CountsOnWhenASourceBecomesMember) {
  send(sender(1, 4000), 100'000, milliseconds(200));
  ASSERT_EQ(budget_.muted(), 1u);
  know({sender(1, 4000), sender(7, 9)});
  EXPECT_FALSE(budget_.admit(sender(1, 4000), now_, false));
  EXPECT_EQ(budget_.muted(), 1u);
  budget_.look(now_ + milliseconds(350));
  EXPECT_EQ(budget_.muted(), 0u);
}

// Datagrams that waited in the kernel while this peer was stopped count by their arrival times.
TEST_F(Budget, CountsArrivalTimesInsteadOfReadTimes) {
  std::size_t admitted = 0;
  for (int i = 0; i < 30'000; ++i)
    admitted += budget_.admit(sender(1, 3000), now_ + i * microseconds(67), false) ? 1 : 0;
  EXPECT_EQ(admitted, 30'000u);
}

// Forged addresses fill the table. Known sources are still counted; new ones pass without a limit.
TEST_F(Budget, ForgedAddressesNeitherGrowNorResetIt) {
  send(sender(1, 4000), 100'000, milliseconds(200));
  ASSERT_EQ(budget_.muted(), 1u);
  for (std::uint32_t i = 0; i < 65'000; ++i, now_ += nanoseconds(1000)) {
    EXPECT_TRUE(budget_.admit(sender(2 + i, 9), now_, true));
    EXPECT_FALSE(budget_.admit(sender(1, 4000), now_, true));
  }
}

}  // namespace
}  // namespace reckon::peer
