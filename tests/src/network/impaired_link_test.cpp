// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/impaired_link.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::impaired_link_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

const GroupAddress kGroup = *IpEndpoint::parse("239.192.77.1:31077");
constexpr std::uint32_t kSent = 600;
constexpr std::uint64_t kSeed = 2026;
constexpr std::uint64_t kReceiver = 1;

std::array<std::byte, 4> octets_of(std::uint32_t value) {
  std::array<std::byte, 4> out;
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

// How often each number arrived.
using Arrivals = std::map<std::uint32_t, int>;

// Tests of other programs may send to the same group on loopback: `from` excludes them.
void collect(Link& link, Arrivals& arrivals, const IpEndpoint* from = nullptr) {
  std::array<Datagram, 16> batch;
  while (const std::size_t count = link.receive(batch)) {
    for (std::size_t i = 0; i < count; ++i) {
      if (from != nullptr && batch[i].sender != *from) continue;
      std::uint32_t value = 0;
      std::memcpy(&value, batch[i].bytes.data(), sizeof value);
      ++arrivals[value];
    }
  }
}

ImpairmentLaw law() {
  ImpairmentLaw out;
  out.delay = 4ms;
  out.jitter = 3ms;
  out.loss = 0.1;
  out.burst_loss = 0.1;
  out.burst_length = 6;
  out.reorder = 0.05;
  out.duplicate = 0.08;
  return out;
}

ImpairedLinkOptions options() {
  ImpairedLinkOptions out;
  out.law = law();
  out.seed = kSeed;
  out.receiver = kReceiver;
  return out;
}

// The datagrams that the simulated network itself passes.
Arrivals through_simulated_network() {
  ManualClock clock;
  SimulatedNetworkOptions network_options;
  network_options.seed = kSeed;
  SimulatedNetwork network(network_options, clock);
  network.impair(law());
  EXPECT_FALSE(network.link(kReceiver).join(kGroup));
  Arrivals arrivals;
  for (std::uint32_t i = 0; i < kSent; ++i) {
    network.link(0).send(kGroup, octets_of(i));
    clock.advance(1ms);
    collect(network.link(kReceiver), arrivals);
  }
  clock.advance(1s);
  collect(network.link(kReceiver), arrivals);
  return arrivals;
}

TEST(ImpairedLink, DecidesAsTheSimulatedNetworkDoes) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairedLink link(network.link(kReceiver), options(), clock);
  EXPECT_FALSE(link.join(kGroup));
  Arrivals arrivals;
  for (std::uint32_t i = 0; i < kSent; ++i) {
    network.link(0).send(kGroup, octets_of(i));
    clock.advance(1ms);
    collect(link, arrivals);
  }
  clock.advance(1s);
  collect(link, arrivals);
  EXPECT_EQ(arrivals, through_simulated_network());
  EXPECT_LT(arrivals.size(), kSent);
  EXPECT_GT(link.statistics().lost_by_law, 0u);
  EXPECT_GT(link.statistics().duplicated_by_law, 0u);
}

TEST(ImpairedLink, ImpairsRealLinksAsTheSimulatedNetworkDoes) {
  const SteadyClock clock;
  UdpMulticastOptions real;
  real.interface = "lo";
  UdpMulticast sender(real, clock), receiver(real, clock);
  ImpairedLink link(receiver, options(), clock);
  const IpEndpoint from = sender.local_endpoint();
  link.number_sender(from, 0);
  ASSERT_FALSE(link.join(kGroup));
  Arrivals arrivals;
  for (std::uint32_t i = 0; i < kSent; ++i) {
    ASSERT_TRUE(sender.send(kGroup, octets_of(i)));
    collect(link, arrivals, &from);
  }
  const Arrivals expected = through_simulated_network();
  const nanoseconds limit = clock.now() + 3s;
  while (arrivals != expected && clock.now() < limit) {
    link.wait(5ms);
    collect(link, arrivals, &from);
  }
  EXPECT_EQ(arrivals, expected) << "seed " << kSeed;
}

TEST(ImpairedLink, ReleasesAtTheTimeTheLawGives) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairedLinkOptions delayed;
  delayed.law.delay = 20ms;
  ImpairedLink link(network.link(1), delayed, clock);
  EXPECT_FALSE(link.join(kGroup));
  network.link(0).send(kGroup, octets_of(5));
  std::array<Datagram, 4> batch;
  EXPECT_EQ(link.receive(batch), 0u);
  clock.advance(20ms - 1ns);
  EXPECT_FALSE(link.wait(1s));
  EXPECT_EQ(link.receive(batch), 0u);
  clock.advance(1ns);
  EXPECT_TRUE(link.wait(1s));
  ASSERT_EQ(link.receive(batch), 1u);
  EXPECT_EQ(batch[0].received, 20ms);
  EXPECT_EQ(batch[0].group, kGroup);
}

// First the law delays, then it loses all, then it equals the network. Delayed datagrams arrive at
// their original due time.
TEST(ImpairedLink, FollowsALawThatChangesWhileItRuns) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairedLink link(network.link(1), {}, clock);
  ASSERT_FALSE(link.join(kGroup));
  Arrivals arrivals;
  const auto send = [&](std::uint32_t number, nanoseconds later) {
    network.link(0).send(kGroup, octets_of(number));
    collect(link, arrivals);
    clock.advance(later);
    collect(link, arrivals);
  };
  link.change_law(delayed_by(0.05));
  send(1, 10ms);
  EXPECT_FALSE(arrivals.contains(1));
  link.change_law(delayed_by(0, 0, 1));
  send(2, 10ms);
  link.change_law({});
  send(3, 1ms);
  EXPECT_EQ(arrivals, (Arrivals{{3, 1}}));
  clock.advance(50ms);
  collect(link, arrivals);
  EXPECT_EQ(arrivals, (Arrivals{{1, 1}, {3, 1}}));
  EXPECT_THROW(link.change_law(delayed_by(-1)), std::invalid_argument);
}

TEST(ImpairedLink, WaitsNoLongerThanTheNextDueTime) {
  const SteadyClock clock;
  UdpMulticastOptions real;
  real.interface = "lo";
  UdpMulticast sender(real, clock), receiver(real, clock);
  ImpairedLinkOptions delayed;
  delayed.law.delay = 30ms;
  ImpairedLink link(receiver, delayed, clock);
  ASSERT_FALSE(link.join(kGroup));
  const IpEndpoint from = sender.local_endpoint();
  const nanoseconds start = clock.now();
  ASSERT_TRUE(sender.send(kGroup, octets_of(5)));
  Arrivals arrivals;
  while (arrivals.empty() && clock.now() - start < 5s) {
    link.wait(5s);
    collect(link, arrivals, &from);
  }
  EXPECT_EQ(arrivals, (Arrivals{{5, 1}}));
  EXPECT_GE(clock.now() - start, 30ms);
  EXPECT_LT(clock.now() - start, 2s);  // far below the 5 s requested, even on a busy machine
}

TEST(ImpairedLink, LosesOthersForAnotherReceiver) {
  ManualClock clock;
  SimulatedNetworkOptions three;
  three.links = 3;
  SimulatedNetwork network(three, clock);
  ImpairedLinkOptions first = options(), second = options();
  second.receiver = 2;
  ImpairedLink a(network.link(1), first, clock), b(network.link(2), second, clock);
  EXPECT_FALSE(a.join(kGroup));
  EXPECT_FALSE(b.join(kGroup));
  Arrivals at_a, at_b;
  for (std::uint32_t i = 0; i < kSent; ++i) {
    network.link(0).send(kGroup, octets_of(i));
    collect(a, at_a);
    collect(b, at_b);
  }
  clock.advance(1s);
  collect(a, at_a);
  collect(b, at_b);
  EXPECT_NE(at_a, at_b);
}

TEST(ImpairedLink, CountsDatagramsThatDoNotFitItsQueue) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairedLinkOptions small;
  small.law.delay = 1s;
  small.queue = 5;
  small.max_datagram = 8;
  ImpairedLink link(network.link(1), small, clock);
  EXPECT_FALSE(link.join(kGroup));
  for (std::uint32_t i = 0; i < 9; ++i) network.link(0).send(kGroup, octets_of(i));
  network.link(0).send(kGroup, std::array<std::byte, 9>{});
  Arrivals arrivals;
  collect(link, arrivals);
  clock.advance(1s);
  collect(link, arrivals);
  EXPECT_EQ(arrivals.size(), 5u);
  EXPECT_EQ(link.statistics().queue_overflows, 4u);
  EXPECT_EQ(link.statistics().truncated, 1u);
  EXPECT_EQ(link.statistics().received, 5u);
}

TEST(ImpairedLink, SharesOneSequenceBeyondItsSenders) {
  ManualClock clock;
  SimulatedNetworkOptions many;
  many.links = 6;
  SimulatedNetwork network(many, clock);
  ImpairedLinkOptions few;
  few.max_senders = 2;
  ImpairedLink link(network.link(5), few, clock);
  EXPECT_FALSE(link.join(kGroup));
  for (std::uint32_t i = 0; i < 5; ++i) network.link(i).send(kGroup, octets_of(i));
  Arrivals arrivals;
  collect(link, arrivals);
  EXPECT_EQ(arrivals.size(), 5u);
}

TEST(ImpairedLink, AllocatesNothingOnceBuilt) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairedLink link(network.link(1), options(), clock);
  EXPECT_FALSE(link.join(kGroup));
  std::array<Datagram, 16> batch;
  std::size_t received = 0;
  const test::AllocationGuard guard;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    clock.advance(1ms);
    network.link(0).send(kGroup, octets_of(i));
    link.wait(1ms);
    received += link.receive(batch);
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(received, 1000u);
}

}  // namespace
}  // namespace reckon::peer::impaired_link_test
