// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/network_read_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tests/src/support/manual_link.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

const GroupPool kPool = GroupPool::ipv4_default();
constexpr std::uint32_t kWaiting = 10'000;

// A datagram of varying length that begins with its number.
std::vector<std::byte> numbered(std::uint32_t number) {
  std::vector<std::byte> octets(4 + number * 7919 % 3000);
  std::memcpy(octets.data(), &number, sizeof number);
  return octets;
}

class ReadLoop : public ::testing::Test {
 protected:
  // The model loop takes up to `most` datagrams and checks their order and content.
  void take(std::size_t most) {
    for (std::size_t i = 0; i < most; ++i) {
      const QueuedDatagram* datagram = ring_.front();
      if (datagram == nullptr) return;
      ASSERT_EQ(datagram->octets.size(), numbered(taken_).size());
      std::uint32_t number = 0;
      std::memcpy(&number, datagram->octets.data(), sizeof number);
      ASSERT_EQ(number, taken_);
      ASSERT_EQ(datagram->group, kPool.address(number % 5));
      ring_.pop();
      ++taken_;
    }
  }

  test::ManualLink link_;
  haptics::SpscRing<GroupCommand> commands_{16};
  DatagramRing ring_{std::size_t{128} << 10};
  Counters counters_;
  NetworkReadLoop loop_{link_, commands_, ring_, counters_};
  std::uint32_t taken_ = 0;
};

TEST_F(ReadLoop, LeavesDatagramsInTheLinkDuringStalls) {
  for (std::uint32_t i = 0; i < kWaiting; ++i) link_.put(kPool.address(i % 5), numbered(i));
  std::size_t read = loop_.step(nanoseconds(1));
  EXPECT_GT(read, 30u);
  EXPECT_TRUE(loop_.is_full());
  EXPECT_EQ(link_.waiting(), kWaiting - read);

  // The model loop stalls: no more datagrams are read, but groups are joined and left.
  ASSERT_TRUE(commands_.push({kPool.address(3), true}));
  ASSERT_TRUE(commands_.push({kPool.address(4), true}));
  ASSERT_TRUE(commands_.push({kPool.address(3), false}));
  EXPECT_EQ(loop_.step(nanoseconds(2)), 0u);
  EXPECT_EQ(link_.joined(), std::vector{kPool.address(4)});
  EXPECT_EQ(link_.waiting(), kWaiting - read);

  // It resumes irregularly: all datagrams arrive, each once, in order.
  for (std::size_t turn = 0; taken_ < kWaiting; ++turn) {
    ASSERT_LT(turn, 100'000u);
    take(turn * turn % 40);
    if (HasFatalFailure()) return;
    read += loop_.step(nanoseconds(3));
  }
  EXPECT_EQ(read, kWaiting);
  EXPECT_EQ(link_.waiting(), 0u);
  EXPECT_FALSE(loop_.is_full());
  EXPECT_EQ(counters_.find("datagrams_in")->value(), kWaiting);
  EXPECT_GT(counters_.find("read_waits")->value(), 10u);
}

TEST_F(ReadLoop, ReportsFullOnlyWhileItIs) {
  EXPECT_EQ(loop_.step(nanoseconds(1)), 0u);
  EXPECT_FALSE(loop_.is_full());
  EXPECT_EQ(counters_.find("read_waits")->value(), 0u);
  for (std::uint32_t i = 0; i < 200; ++i) link_.put(kPool.address(i % 5), numbered(i));
  while (!loop_.is_full()) ASSERT_GT(loop_.step(nanoseconds(1)), 0u);
  while (taken_ < 200) {
    take(200);
    if (HasFatalFailure()) return;
    static_cast<void>(loop_.step(nanoseconds(1)));
  }
  EXPECT_FALSE(loop_.is_full());
}

// A flood of one sender and a few datagrams of another one: the few are queued, whatever the flood
// sends.
TEST(NetworkReadLoop, QueuesNeitherJunkNorAFlood) {
  ManualClock clock(seconds(1), nanoseconds(0));
  SimulatedNetworkOptions options;
  options.links = 3;
  SimulatedNetwork network(options, clock);
  haptics::SpscRing<GroupCommand> commands(16);
  DatagramRing inbound(std::size_t{1} << 20);
  Counters counters;
  NetworkReadLoop loop(network.link(0), commands, inbound, counters, std::uint8_t{1});
  const auto count = [&](const char* name) { return counters.find(name)->value(); };
  static_cast<void>(commands.push({kPool.base(), true}));
  loop.step(clock.now());
  std::array<std::byte, 12> good{std::byte{7}, std::byte{1}}, junk{std::byte{0x55}};
  good[9] = std::byte{12};
  std::size_t queued = 0, genuine = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    clock.advance(milliseconds(1));
    for (int i = 0; i < 100; ++i) network.link(1).send(kPool.base(), good);
    if (ms % 10 == 0) network.link(2).send(kPool.base(), good);
    network.link(2).send(kPool.base(), junk);
    loop.step(clock.now());
    for (const QueuedDatagram* next = inbound.front(); next != nullptr; next = inbound.front()) {
      ++queued;
      EXPECT_EQ(next->octets[0], std::byte{7});
      genuine += next->sender == network.link(2).local_endpoint() ? 1 : 0;
      inbound.pop();
    }
  }
  EXPECT_EQ(genuine, 100u);
  EXPECT_LE(queued, genuine + SenderBudget::kMost);
  EXPECT_EQ(count("refused_version_in"), 1000u);
  EXPECT_GE(count("muted_in"), 100'000u - SenderBudget::kMost);
  EXPECT_EQ(count("datagrams_in"), 101'100u);
  ASSERT_NE(loop.muted().front(), nullptr);
  EXPECT_EQ(loop.muted().front()->who, network.link(1).local_endpoint());
}

// A reader of exercise 1 and the datagrams that links send to it.
struct Gate {
  explicit Gate(bool lenient = false, std::size_t links = 3)
      : network({.links = links}, clock),
        loop(network.link(0), commands, inbound, counters, std::uint8_t{1}, lenient) {
    static_cast<void>(commands.push({kPool.base(), true}));
    loop.step(clock.now());
  }
  void send(std::size_t link, std::uint8_t exercise, std::uint8_t length) {
    std::array<std::byte, 12> pdu{std::byte{7}, std::byte{exercise}};
    pdu[9] = std::byte{length};
    network.link(link).send(kPool.base(), pdu);
    pass(milliseconds(1));
  }
  void pass(nanoseconds time) {
    clock.advance(time);
    loop.step(clock.now());
  }
  std::vector<std::string> reports() {
    std::vector<std::string> all;
    while (const RefusedSender* sender = loop.refused().front()) {
      all.emplace_back(notice_of(*sender, true).text.data());
      loop.refused().pop();
    }
    return all;
  }
  ManualClock clock{seconds(1), nanoseconds(0)};
  SimulatedNetwork network;
  haptics::SpscRing<GroupCommand> commands{16};
  DatagramRing inbound{std::size_t{1} << 20};
  Counters counters;
  NetworkReadLoop loop;
};

TEST(NetworkReadLoop, ReportsARefusedSenderOnceForEachReason) {
  Gate gate;
  for (int i = 0; i < 32; ++i) gate.send(1, 1, 0);
  for (int i = 0; i < 3; ++i) gate.send(2, 9, 12);
  EXPECT_THAT(gate.reports(), IsEmpty());
  gate.pass(seconds(1));
  const std::string one = gate.network.link(1).local_endpoint().text();
  const std::string two = gate.network.link(2).local_endpoint().text();
  EXPECT_THAT(gate.reports(),
              ElementsAre(one + ": 32 datagrams refused: length field 0; to read them, set "
                                "lenient in the scene",
                          two + ": 3 datagrams refused: exercise 9, see exercise in the scene"));
  gate.send(1, 1, 0);
  gate.pass(seconds(100));
  EXPECT_THAT(gate.reports(), IsEmpty());
  EXPECT_EQ(gate.counters.find("refused_no_length_in")->value(), 33u);
  EXPECT_EQ(gate.inbound.front(), nullptr);
}

TEST(NetworkReadLoop, SumsFurtherRefusedSenders) {
  Gate gate(false, 2 + RefusedSenders::kMost);
  for (std::size_t link = 1; link < 2 + RefusedSenders::kMost; ++link) gate.send(link, 9, 12);
  gate.pass(seconds(1));
  const auto reports = gate.reports();
  ASSERT_EQ(reports.size(), 1 + RefusedSenders::kMost);
  EXPECT_EQ(reports.back(), "1 datagram of further senders refused");
}

TEST(NetworkReadLoop, ReadsALengthOfZeroIfLenient) {
  Gate gate(true);
  gate.send(1, 1, 0);
  const QueuedDatagram* read = gate.inbound.front();
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->octets.size(), 12u);
  EXPECT_EQ(read->octets[9], std::byte{12}) << "up to the end of the datagram";
  gate.pass(seconds(1));
  EXPECT_THAT(gate.reports(), IsEmpty());
}

TEST(NetworkReadLoop, DropsAndCountsDatagramsOlderThanASecond) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  haptics::SpscRing<GroupCommand> commands(16);
  DatagramRing inbound(std::size_t{64} << 10);
  Counters counters;
  NetworkReadLoop loop(network.link(0), commands, inbound, counters);
  static_cast<void>(commands.push({kPool.base(), true}));
  loop.step(clock.now());
  const std::byte old{1}, fresh{2};
  network.link(1).send(kPool.base(), {&old, 1});
  clock.advance(milliseconds(1001));
  network.link(1).send(kPool.base(), {&fresh, 1});
  EXPECT_EQ(loop.step(clock.now()), 1u);
  ASSERT_NE(inbound.front(), nullptr);
  EXPECT_EQ(inbound.front()->octets[0], fresh);
  inbound.pop();
  EXPECT_TRUE(inbound.empty());
  EXPECT_EQ(counters.find("stale_datagrams")->value(), 1u);
}

TEST(NetworkReadLoop, ReportsAndFirstRetriesAMissingBaseGroup) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.max_groups = 1;
  SimulatedNetwork network(options, clock);
  static_cast<void>(network.link(0).join(kPool.address(9)));  // takes the only place
  haptics::SpscRing<GroupCommand> commands(16);
  DatagramRing inbound(std::size_t{64} << 10);
  Counters counters;
  NetworkReadLoop loop(network.link(0), commands, inbound, counters);
  static_cast<void>(commands.push({kPool.base(), true}));
  for (std::size_t i = 0; i < 5; ++i) static_cast<void>(commands.push({kPool.address(i), true}));
  loop.step(seconds(1));
  EXPECT_EQ(counters.find("base_unjoined")->value(), 1u);
  for (int i = 2; i < 8; ++i) loop.step(seconds(i));
  network.link(0).leave(kPool.address(9));
  loop.step(seconds(8));
  EXPECT_EQ(counters.find("base_unjoined")->value(), 0u);
  EXPECT_EQ(counters.find("groups_unjoined")->value(), 5u);
}

TEST(NetworkReadLoop, RetriesARefusedGroupUntilJoinedOrLeft) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.max_groups = 2;
  SimulatedNetwork network(options, clock);
  haptics::SpscRing<GroupCommand> commands(16);
  DatagramRing inbound(std::size_t{64} << 10);
  Counters counters;
  NetworkReadLoop loop(network.link(0), commands, inbound, counters);
  const auto count = [&](const char* name) { return counters.find(name)->value(); };
  const GroupPool pool = GroupPool::ipv4_default();
  for (std::size_t i = 0; i < 5; ++i) static_cast<void>(commands.push({pool.address(i), true}));
  loop.step(seconds(1));
  EXPECT_EQ(count("join_errors"), 3u);
  EXPECT_EQ(count("groups_unjoined"), 3u);

  // One group is no longer wanted; one place becomes free.
  static_cast<void>(commands.push({pool.address(4), false}));
  static_cast<void>(commands.push({pool.address(0), false}));
  loop.step(seconds(1) + milliseconds(999));
  EXPECT_EQ(count("groups_unjoined"), 2u);
  loop.step(seconds(2));
  EXPECT_EQ(count("groups_unjoined"), 1u);
  static_cast<void>(commands.push({pool.address(1), false}));
  loop.step(seconds(2) + milliseconds(1));
  EXPECT_EQ(count("groups_unjoined"), 1u) << "not more often than each second";
  loop.step(seconds(3));
  EXPECT_EQ(count("groups_unjoined"), 0u);
  EXPECT_EQ(count("join_errors"), 3u);

  // Groups 2 and 3 are received.
  clock.advance(seconds(3));
  const std::byte octet{1};
  for (std::size_t i = 0; i < 5; ++i) network.link(1).send(pool.address(i), {&octet, 1});
  loop.step(seconds(3));
  for (const std::size_t expected : {2u, 3u}) {
    ASSERT_NE(inbound.front(), nullptr);
    EXPECT_EQ(inbound.front()->group, pool.address(expected));
    inbound.pop();
  }
  EXPECT_EQ(inbound.front(), nullptr);
}

// Datagrams of contact groups have a ring of their own: they do not wait behind others.
TEST(NetworkReadLoop, KeepsContactDatagramsInTheirOwnRing) {
  test::ManualLink link;
  haptics::SpscRing<GroupCommand> commands(16);
  DatagramRing others(std::size_t{64} << 10), felt(std::size_t{64} << 10);
  Counters counters;
  const GroupPool contacts(kPool.address(99), 100);
  NetworkReadLoop loop(link, commands, others, counters, {}, false, nullptr,
                       UrgentRing{contacts, felt});
  for (std::uint32_t i = 0; i < 3; ++i) link.put(kPool.address(99), numbered(i));
  link.put(kPool.address(100), numbered(3));
  link.put(kPool.base(), numbered(4));
  link.put(kPool.address(199), numbered(5));
  EXPECT_EQ(loop.step(nanoseconds(1)), 6u);
  const auto count = [](DatagramRing& ring) {
    std::array<QueuedDatagram, 8> all;
    return ring.front(all);
  };
  EXPECT_EQ(count(others), 4u);
  EXPECT_EQ(count(felt), 2u);

  // Whichever ring is full, nothing is dropped.
  for (std::uint32_t i = 0; i < 1000; ++i) link.put(kPool.address(100), numbered(i));
  static_cast<void>(loop.step(nanoseconds(2)));
  EXPECT_TRUE(loop.is_full());
  EXPECT_GT(link.waiting(), 0u);
}

TEST_F(ReadLoop, DistinguishesArrivalsThatCanBeFelt) {
  const auto put = [&](const IpEndpoint& from) {
    link_.put(kPool.address(0), numbered(0), from);
    return loop_.step(nanoseconds(1)) > 0 && loop_.has_taken_felt();
  };
  const IpEndpoint near = IpEndpoint::v4(0x0a000001, 3000), far = IpEndpoint::v4(0x0a000001, 3001);
  EXPECT_TRUE(put(far)) << "before the model loop has looked all may be felt";
  FeltSources felt;
  felt.all = false;
  felt.sources[felt.count++] = near;
  loop_.felt().write(felt);
  EXPECT_FALSE(put(far));
  EXPECT_TRUE(put(near));
  EXPECT_TRUE(put({})) << "a link without sender addresses";
  EXPECT_EQ(loop_.step(nanoseconds(2)), 0u);
  EXPECT_FALSE(loop_.has_taken_felt()) << "nothing has come";
}

}  // namespace
}  // namespace reckon::peer
