// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Balances of datagrams over real links, impaired links and unicast lists.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/peer/network/datagram_balance.hpp"
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
using Octets = std::vector<std::byte>;
using balances::DatagramBalances;
using balances::kLife;

Octets datagram(std::uint32_t number, std::size_t before = 40) {
  Octets octets(before + pdu::kDatagramTrailerSize);
  pdu::DatagramTrailer trailer;
  trailer.sequence = number;
  trailer.epoch = kLife;
  EXPECT_EQ(pdu::encode(trailer, std::span(octets).subspan(before)), pdu::kDatagramTrailerSize);
  return octets;
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
  b.leave(group(1));  // with two datagrams unread
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

// The kernel takes long to leave a group while interfaces change elsewhere. Datagrams that arrive
// meanwhile may count either way; datagrams sent before have arrived.
TEST_F(DatagramBalances, CountAllDatagramsBeforeAGroupIsLeft) {
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

// A run that is not yet returned may hold all buffers.
TEST_F(DatagramBalances, ReportLeftGroupsWhileABatchIsFull) {
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

// After the last datagram that was read, no further datagram carries the count of drops.
TEST_F(DatagramBalances, CountTheLastKernelDrops) {
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

TEST_F(DatagramBalances, RecordTheImpairmentOfEachDatagram) {
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
  EXPECT_EQ(link.receive(out), 0u);  // all are delayed
  link.settle();
  const LinkStatistics statistics = link.statistics();
  const auto sums = counts();
  EXPECT_GT(statistics.lost_by_law, 50u);
  EXPECT_EQ(of(sums, DatagramFate::lost_by_law), statistics.lost_by_law);
  EXPECT_EQ(of(sums, DatagramFate::copied_by_law), statistics.duplicated_by_law);
  EXPECT_EQ(of(sums, DatagramFate::unread),
            500 - statistics.lost_by_law + statistics.duplicated_by_law);
}

// A list of three peers: both ends count each copy under the group it was sent to.
TEST_F(DatagramBalances, HoldForUnicastLists) {
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

TEST_F(DatagramBalances, ReportAListWithoutOtherPeers) {
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
