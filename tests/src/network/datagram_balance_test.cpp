// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/datagram_balance.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <initializer_list>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/peer/network/fan_out_link.hpp"
#include "reckon/peer/network/impaired_link.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;
using aoim::SequenceVerdict;

constexpr std::uint32_t kLife = 77;

DatagramEvent event(DatagramFate fate, std::uint32_t number = 0) {
  DatagramEvent event;
  event.group = group(1);
  event.epoch = kLife;
  event.sequence = number;
  event.fate = fate;
  return event;
}

using Octets = std::vector<std::byte>;

Octets datagram(std::uint32_t number, std::size_t before = 40) {
  Octets octets(before + pdu::kDatagramTrailerSize);
  pdu::DatagramTrailer trailer;
  trailer.sequence = number;
  trailer.epoch = kLife;
  EXPECT_EQ(pdu::encode(trailer, std::span(octets).subspan(before)), pdu::kDatagramTrailerSize);
  return octets;
}

class DatagramBalances : public testing::Test {
 protected:
  void arrive(std::initializer_list<std::uint32_t> numbers) {
    for (const std::uint32_t number : numbers) balance_.take(event(DatagramFate::arrived, number));
  }
  [[nodiscard]] Stretch only_stretch() {
    const BalanceReport report = balance_.report(0s, true);
    EXPECT_EQ(report.stretches.size(), 1u);
    return report.stretches.empty() ? Stretch{} : report.stretches.front();
  }
  /// Everything in the tap, by fate.
  [[nodiscard]] std::array<std::uint64_t, kFates> counts() {
    balance_.look();
    std::array<std::uint64_t, kFates> sums{};
    for (const FateCounts& row : balance_.report(0s, true).fates) {
      EXPECT_EQ(row.key.epoch, kLife);
      for (std::size_t i = 0; i < kFates; ++i) sums[i] += row.counts[i];
    }
    return sums;
  }
  static std::uint64_t of(const std::array<std::uint64_t, kFates>& counts, DatagramFate fate) {
    return counts[static_cast<std::size_t>(fate)];
  }

  DatagramTap tap_;
  DatagramBalance balance_{tap_};
};

TEST_F(DatagramBalances, CountWhatIsMissingUntilItComesLate) {
  arrive({5, 6, 9, 10});
  arrive({7});
  const Stretch stretch = only_stretch();
  EXPECT_EQ(stretch.first, 5u);
  EXPECT_EQ(stretch.last, 10u);
  EXPECT_EQ(stretch.arrived, 5u);
  EXPECT_EQ(stretch.missing, 1u);
  EXPECT_EQ(stretch.copies, 0u);
}

TEST_F(DatagramBalances, BeginAStretchAtTheLeastNumberThatArrived) {
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

// A group that is left and joined again at once: what came by each membership is told apart.
TEST_F(DatagramBalances, SayOfWhichMembershipAStretchIs) {
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

TEST_F(DatagramBalances, TellEachEventOnce) {
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

TEST_F(DatagramBalances, ForgetWhoIsSilentForFiveMinutes) {
  arrive({1, 2});
  EXPECT_TRUE(balance_.report(10s, false).stretches.empty());
  EXPECT_TRUE(balance_.report(200s, false).stretches.empty());
  EXPECT_EQ(balance_.report(310s, false).stretches.size(), 1u);
  EXPECT_TRUE(balance_.report(310s, true).stretches.empty());
}

// The tracker believes a number that lies far ahead when a second one agrees.
TEST_F(DatagramBalances, FollowWhatTheTrackerCountsAsLost) {
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

TEST_F(DatagramBalances, SayThatEventsWereMissed) {
  DatagramTap small(4);
  DatagramBalance balance(small);
  for (int i = 0; i < 6; ++i) small.push(DatagramTap::Loop::read, event(DatagramFate::arrived, 1));
  balance.look();
  EXPECT_EQ(balance.report(0s, true).missed, 2u);
}

TEST_F(DatagramBalances, HoldOverARealLink) {
  UdpMulticastOptions options = on("lo");
  options.tap = &tap_;
  UdpMulticast a(options, kClock), b(options, kClock);
  ASSERT_FALSE(b.join(group(1)));
  std::vector<Octets> datagrams;
  std::vector<OutgoingDatagram> batch;
  for (std::uint32_t number = 1; number <= 5; ++number) datagrams.push_back(datagram(number));
  for (const Octets& one : datagrams) batch.push_back({group(1), one});
  EXPECT_EQ(a.send_batch(batch).datagrams, 5u);
  EXPECT_FALSE(a.send(group(1), Octets(70'000)));
  EXPECT_EQ(hear(b).size(), 5u);
  EXPECT_TRUE(a.send(group(1), datagram(6)));
  EXPECT_TRUE(a.send(group(1), datagram(7)));
  b.leave(group(1));  // with two unread
  balance_.look();
  const BalanceReport report = balance_.report(0s, true);
  ASSERT_EQ(report.stretches.size(), 1u);
  EXPECT_EQ(report.stretches[0].arrived, 7u);
  EXPECT_EQ(report.stretches[0].missing, 0u);
  ASSERT_EQ(report.memberships.size(), 1u);
  EXPECT_LT(report.memberships[0].joined, report.memberships[0].left);
  std::array<std::uint64_t, kFates> sums{};
  for (const FateCounts& row : report.fates) {
    for (std::size_t i = 0; i < kFates; ++i) sums[i] += row.counts[i];
  }
  EXPECT_EQ(of(sums, DatagramFate::sent), 7u);
  EXPECT_EQ(of(sums, DatagramFate::send_error), 1u);
  EXPECT_EQ(of(sums, DatagramFate::arrived), 7u);
  EXPECT_EQ(of(sums, DatagramFate::unread), 2u);
}

// Leaving takes the kernel long while interfaces change elsewhere: what comes meanwhile is at the
// edge, what was sent before has arrived.
TEST_F(DatagramBalances, HaveAllThatCameBeforeAGroupWasLeft) {
  UdpMulticastOptions options = on("lo");
  UdpMulticast a(options, kClock);
  options.tap = &tap_;
  UdpMulticast b(options, kClock);
  constexpr std::uint32_t kRounds = 200, kEach = 40;
  std::vector<std::chrono::nanoseconds> sent(kRounds * kEach + 1);
  std::atomic<std::uint32_t> last{0}, goal{0};
  std::thread sender([&] {
    for (std::uint32_t number = 1; number < sent.size(); ++number) {
      while (number > goal) std::this_thread::yield();
      a.send(group(1), datagram(number));
      sent[number] = kClock.now();
      last = number;
    }
  });
  for (std::uint32_t round = 1; round <= kRounds; ++round) {
    ASSERT_FALSE(b.join(group(1)));
    goal = round * kEach;
    while (last < goal - kEach / 2) hear(b, 0ns);
    b.leave(group(1));
    balance_.look();
  }
  sender.join();
  const BalanceReport report = balance_.report(0s, true);
  ASSERT_EQ(report.missed, 0u);
  ASSERT_EQ(report.memberships.size(), kRounds);
  for (std::size_t i = 0; i < report.stretches.size(); ++i) {
    const Stretch& stretch = report.stretches[i];
    const auto membership =
        std::ranges::find(report.memberships, stretch.joined, &Membership::joined);
    ASSERT_NE(membership, report.memberships.end());
    EXPECT_LE(membership->joining, membership->joined);
    EXPECT_LE(membership->joined, membership->leaving);
    EXPECT_LE(membership->leaving, membership->left);
    EXPECT_EQ(stretch.missing, membership->kernel_drops);
    if (membership->kernel_drops > 0 || stretch.last == kRounds * kEach) continue;
    EXPECT_GE(sent[stretch.last + 1], membership->leaving) << "the first that did not arrive";
  }
}

// A run that is not handed up yet may hold all buffers.
TEST_F(DatagramBalances, TellOfAGroupThatIsLeftWhileABatchIsFull) {
  UdpMulticastOptions options = on("lo");
  UdpMulticast a(options, kClock);
  options.tap = &tap_;
  options.batch = 1;
  UdpMulticast b(options, kClock);
  ASSERT_FALSE(b.join(group(1)));
  ASSERT_FALSE(b.join(group(2)));
  const std::array<Octets, 3> run{datagram(1), datagram(2), datagram(3)};
  const std::array<OutgoingDatagram, 3> batch{
      {{group(1), run[0]}, {group(1), run[1]}, {group(1), run[2]}}};
  EXPECT_EQ(a.send_batch(batch).datagrams, 3u);
  std::array<Datagram, 1> out;
  EXPECT_EQ(b.receive(out), 1u);
  for (const std::uint32_t number : {1u, 2u}) a.send(group(2), datagram(number));
  b.leave(group(2));
  const auto sums = counts();
  EXPECT_EQ(of(sums, DatagramFate::arrived), 1u + 2u);
  EXPECT_EQ(of(sums, DatagramFate::unread), 2u);
}

// What comes behind the last datagram that was read has no other to tell of it.
TEST_F(DatagramBalances, KnowWhatTheKernelDroppedLast) {
  UdpMulticastOptions options = on("lo");
  options.tap = &tap_;
  options.receive_buffer = 4096;
  options.offload = false;
  UdpMulticast b(options, kClock);
  options.tap = nullptr;
  UdpMulticast a(options, kClock);
  ASSERT_FALSE(b.join(group(1)));
  for (std::uint32_t number = 1; number <= 200; ++number) a.send(group(1), datagram(number, 1000));
  b.settle();
  balance_.look();
  const BalanceReport report = balance_.report(0s, true);
  ASSERT_EQ(report.stretches.size(), 1u);
  ASSERT_EQ(report.memberships.size(), 1u);
  EXPECT_GT(report.memberships[0].kernel_drops, 100u);
  EXPECT_EQ(report.memberships[0].kernel_drops + report.stretches[0].arrived, 200u);
  EXPECT_EQ(b.statistics().kernel_drops, report.memberships[0].kernel_drops);
}

TEST_F(DatagramBalances, TellWhatTheLawDidToWhom) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairedLinkOptions options;
  options.law.loss = 0.2;
  options.law.duplicate = 0.2;
  options.law.delay = 10ms;
  options.tap = &tap_;
  ImpairedLink link(network.link(1), options, clock);
  ASSERT_FALSE(link.join(group(1)));
  for (std::uint32_t number = 1; number <= 500; ++number)
    network.link(0).send(group(1), datagram(number));
  std::array<Datagram, 8> out;
  EXPECT_EQ(link.receive(out), 0u);  // all are under way
  link.settle();
  const LinkStatistics statistics = link.statistics();
  const auto sums = counts();
  EXPECT_GT(statistics.lost_by_law, 50u);
  EXPECT_EQ(of(sums, DatagramFate::lost_by_law), statistics.lost_by_law);
  EXPECT_EQ(of(sums, DatagramFate::copied_by_law), statistics.duplicated_by_law);
  EXPECT_EQ(of(sums, DatagramFate::unread),
            500 - statistics.lost_by_law + statistics.duplicated_by_law);
}

// Three of a list: each copy is told under the group that it was said to, at both ends.
TEST_F(DatagramBalances, HoldWhereDatagramsGoToAListOfAddresses) {
  const GroupPool pool = GroupPool::ipv4_default();
  UdpMulticastOptions options = on("lo");
  UdpMulticast c(options, kClock);
  options.framed = pool;
  DatagramTap heard;
  options.tap = &heard;
  UdpMulticast b(options, kClock);
  options.tap = &tap_;
  UdpMulticast a(options, kClock);
  FanOutOptions to;
  to.peers = {a.local_endpoint(), b.local_endpoint(), c.local_endpoint()};
  to.tap = &tap_;
  FanOutLink from(a, pool, to);
  to.tap = &heard;
  FanOutLink listener(b, pool, to);
  static_cast<void>(listener.join(pool.address(1)));
  for (std::uint32_t number = 1; number <= 20; ++number) {
    const Octets one = datagram(number);
    const GroupAddress group = pool.address(number % 2);
    tap_.note(DatagramTap::Loop::model, DatagramFate::numbered, group, one);
    EXPECT_TRUE(from.send(group, one));
  }
  EXPECT_EQ(hear(listener).size(), 10u);
  listener.settle();

  balance_.look();
  const BalanceReport told = balance_.report(0s, true);
  ASSERT_EQ(told.fates.size(), 2u);
  for (const FateCounts& row : told.fates) {
    EXPECT_EQ(row.key.epoch, kLife);
    EXPECT_TRUE(pool.index(row.key.group)) << row.key.group.text();
    EXPECT_EQ(of(row.counts, DatagramFate::numbered), 10u);
    EXPECT_EQ(of(row.counts, DatagramFate::copied_to_list), 10u);
    EXPECT_EQ(of(row.counts, DatagramFate::sent), 20u);
  }
  DatagramBalance listening(heard);
  listening.look();
  const BalanceReport report = listening.report(0s, true);
  ASSERT_EQ(report.fates.size(), 2u);
  for (const FateCounts& row : report.fates) {
    EXPECT_EQ(of(row.counts, DatagramFate::arrived), 10u);
    const bool is_joined = row.key.group == pool.address(1);
    EXPECT_EQ(of(row.counts, DatagramFate::not_listened), is_joined ? 0u : 10u);
  }
  ASSERT_EQ(report.memberships.size(), 1u) << "its own address, to which all come";
  EXPECT_EQ(report.memberships[0].group, b.local_endpoint());
}

TEST_F(DatagramBalances, TellThatAListNamesNobodyElse) {
  const GroupPool pool = GroupPool::ipv4_default();
  UdpMulticastOptions options = on("lo");
  options.framed = pool;
  options.tap = &tap_;
  UdpMulticast a(options, kClock);
  FanOutOptions to;
  to.peers = {a.local_endpoint()};
  to.tap = &tap_;
  FanOutLink alone(a, pool, to);
  static_cast<void>(alone.send(pool.base(), datagram(1)));
  const auto sums = counts();
  EXPECT_EQ(of(sums, DatagramFate::to_nobody), 1u);
  EXPECT_EQ(of(sums, DatagramFate::sent), 0u);
}

TEST_F(DatagramBalances, CostTheLoopsNoAllocation) {
  const Octets one = datagram(1);
  AllocationGuard guard;
  for (int i = 0; i < 100; ++i)
    tap_.note(DatagramTap::Loop::read, DatagramFate::arrived, group(1), one);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::peer
