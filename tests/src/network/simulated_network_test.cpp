// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/simulated_network.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

const GroupAddress kGroup = GroupPool::ipv4_default().address(0);
const GroupAddress kOther = GroupPool::ipv4_default().address(1);

std::array<std::byte, 4> octets_of(std::uint32_t value) {
  std::array<std::byte, 4> out;
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

std::uint32_t value_of(const Datagram& datagram) {
  std::uint32_t value = 0;
  EXPECT_EQ(datagram.bytes.size(), sizeof value);
  std::memcpy(&value, datagram.bytes.data(), sizeof value);
  return value;
}

std::vector<std::uint32_t> drain(Link& link) {
  std::vector<std::uint32_t> out;
  std::array<Datagram, 7> batch;
  while (const std::size_t count = link.receive(batch)) {
    for (std::size_t i = 0; i < count; ++i) out.push_back(value_of(batch[i]));
  }
  return out;
}

// All datagrams that reach link 1 of a network under `law`, with their times, as one hash.
std::uint64_t run_hash(const ImpairmentLaw& law, std::uint64_t seed) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.links = 3;
  options.seed = seed;
  SimulatedNetwork network(options, clock);
  network.impair(law);
  EXPECT_FALSE(network.link(1).join(kGroup));
  std::uint64_t sum = 0xcbf29ce484222325u;
  std::array<Datagram, 16> batch;
  for (std::uint32_t step = 0; step < 3000; ++step) {
    clock.advance(1ms);
    network.link(step % 2 == 0 ? 0 : 2).send(kGroup, octets_of(step));
    while (const std::size_t count = network.link(1).receive(batch)) {
      for (std::size_t i = 0; i < count; ++i) {
        const auto time = static_cast<std::uint64_t>(batch[i].received.count());
        sum = (sum ^ value_of(batch[i]) ^ (time << 20)) * 0x100000001b3u;
      }
    }
  }
  return sum;
}

ImpairmentLaw bad_law() {
  ImpairmentLaw law;
  law.delay = 30ms;
  law.jitter = 10ms;
  law.loss = 0.1;
  law.duplicate = 0.05;
  law.burst_loss = 0.05;
  law.burst_length = 5;
  return law;
}

TEST(SimulatedNetwork, ReachesOnlyLinksThatJoined) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.links = 4;
  SimulatedNetwork network(options, clock);
  EXPECT_FALSE(network.link(1).join(kGroup));
  EXPECT_FALSE(network.link(2).join(kOther));
  EXPECT_FALSE(network.link(0).join(kGroup));
  EXPECT_TRUE(network.link(0).send(kGroup, octets_of(7)));
  EXPECT_EQ(drain(network.link(1)), std::vector<std::uint32_t>{7});
  EXPECT_TRUE(drain(network.link(0)).empty());  // not to itself
  EXPECT_TRUE(drain(network.link(2)).empty());
  EXPECT_TRUE(drain(network.link(3)).empty());
  network.link(1).leave(kGroup);
  EXPECT_TRUE(network.link(0).send(kGroup, octets_of(8)));
  EXPECT_TRUE(drain(network.link(1)).empty());
  EXPECT_EQ(network.link(1).statistics().leaves, 1u);
}

TEST(SimulatedNetwork, DropsDelayedDatagramsOfALeftGroup) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairmentLaw law;
  law.delay = 30ms;
  network.impair(law);
  Link& link = network.link(1);
  EXPECT_FALSE(link.join(kGroup));
  EXPECT_FALSE(link.join(kOther));
  network.link(0).send(kGroup, octets_of(1));
  network.link(0).send(kOther, octets_of(2));
  link.leave(kGroup);
  clock.advance(30ms);
  EXPECT_EQ(drain(link), std::vector<std::uint32_t>{2});
  EXPECT_EQ(network.arrived_after_leaving(), 1u);
  EXPECT_EQ(link.statistics().received, 1u);
  EXPECT_EQ(network.in_flight(), 0u);
}

TEST(SimulatedNetwork, OpensAPortAfterTheJoinDelay) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.join_delay = 200ms;
  SimulatedNetwork network(options, clock);
  EXPECT_FALSE(network.link(1).join(kGroup));
  clock.advance(199ms);
  network.link(0).send(kGroup, octets_of(1));
  EXPECT_FALSE(network.link(1).join(kGroup));  // again: no error, and no later
  clock.advance(1ms);
  network.link(0).send(kGroup, octets_of(2));
  EXPECT_EQ(drain(network.link(1)), std::vector<std::uint32_t>{2});
}

TEST(SimulatedNetwork, ReturnsGroupSenderAndTime) {
  ManualClock clock(5s);
  SimulatedNetwork network({}, clock);
  EXPECT_FALSE(network.link(1).join(kGroup));
  network.link(0).send(kGroup, octets_of(1));
  std::array<Datagram, 1> batch;
  ASSERT_EQ(network.link(1).receive(batch), 1u);
  EXPECT_EQ(batch[0].group, kGroup);
  EXPECT_EQ(batch[0].sender, network.link(0).local_endpoint());
  EXPECT_EQ(batch[0].sender.text(), "198.18.0.1:3000");
  EXPECT_EQ(batch[0].received, 5s);
}

TEST(SimulatedNetwork, CarriesUnicast) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.links = 3;
  SimulatedNetwork network(options, clock);
  network.link(0).send(network.link(2).local_endpoint(), octets_of(9));
  EXPECT_TRUE(drain(network.link(1)).empty());
  EXPECT_EQ(drain(network.link(2)), std::vector<std::uint32_t>{9});
}

TEST(SimulatedNetwork, DelaysToTheNanosecond) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  ImpairmentLaw law;
  law.delay = 20ms;
  network.impair(law);
  EXPECT_FALSE(network.link(1).join(kGroup));
  network.link(0).send(kGroup, octets_of(1));
  EXPECT_EQ(network.next_arrival(), 20ms);
  EXPECT_EQ(network.in_flight(), 1u);
  clock.advance(20ms - 1ns);
  EXPECT_FALSE(network.link(1).wait(1s));
  EXPECT_TRUE(drain(network.link(1)).empty());
  clock.advance(1ns);
  EXPECT_TRUE(network.link(1).wait(1s));
  EXPECT_EQ(drain(network.link(1)), std::vector<std::uint32_t>{1});
  EXPECT_EQ(network.next_arrival(), nanoseconds::max());
}

TEST(SimulatedNetwork, KeepsTheOrderOfEqualTimes) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  EXPECT_FALSE(network.link(1).join(kGroup));
  std::vector<std::uint32_t> sent;
  for (std::uint32_t i = 0; i < 500; ++i) {
    network.link(0).send(kGroup, octets_of(i));
    sent.push_back(i);
  }
  EXPECT_EQ(drain(network.link(1)), sent);
}

TEST(SimulatedNetwork, RepeatsItselfFromItsSeed) {
  EXPECT_EQ(run_hash(bad_law(), 4), run_hash(bad_law(), 4));
  EXPECT_NE(run_hash(bad_law(), 4), run_hash(bad_law(), 5));
}

TEST(SimulatedNetwork, ImpairsEachDirectionByItself) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.links = 3;
  SimulatedNetwork network(options, clock);
  ImpairmentLaw none;
  none.loss = 1.0;
  network.impair(0, 1, none);
  for (const std::size_t i : {1u, 2u}) EXPECT_FALSE(network.link(i).join(kGroup));
  network.link(0).send(kGroup, octets_of(1));
  network.link(2).send(kGroup, octets_of(2));
  EXPECT_EQ(drain(network.link(1)), std::vector<std::uint32_t>{2});
  EXPECT_EQ(drain(network.link(2)), std::vector<std::uint32_t>{1});
  EXPECT_EQ(network.link(1).statistics().lost_by_law, 1u);
}

TEST(SimulatedNetwork, StaysWithinItsBoundsAndCountsTheExcess) {
  ManualClock clock;
  SimulatedNetworkOptions options;
  options.datagrams_in_flight = 10;
  options.max_payload = 100;
  options.max_groups = 2;
  SimulatedNetwork network(options, clock);
  EXPECT_FALSE(network.link(1).join(kGroup));
  EXPECT_FALSE(network.link(1).join(kOther));
  EXPECT_FALSE(network.link(1).join(kOther));  // joining again is no error
  EXPECT_TRUE(network.link(1).join(GroupPool::ipv4_default().address(2)));
  EXPECT_TRUE(network.link(1).join(network.link(0).local_endpoint()));
  for (std::uint32_t i = 0; i < 25; ++i) network.link(0).send(kGroup, octets_of(i));
  EXPECT_EQ(drain(network.link(1)).size(), 10u);
  EXPECT_FALSE(network.link(0).send(kGroup, std::vector<std::byte>(101)));
  EXPECT_EQ(network.link(1).statistics().queue_overflows, 15u);
  EXPECT_EQ(network.link(1).statistics().join_errors, 2u);
  EXPECT_EQ(network.link(0).statistics().too_big, 1u);
  EXPECT_EQ(network.link(0).statistics().sent, 25u);
}

TEST(SimulatedNetwork, WakesAWaitOnce) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  EXPECT_FALSE(network.link(0).wait(1s));
  network.link(0).wake();
  EXPECT_TRUE(network.link(0).wait(1s));
  EXPECT_FALSE(network.link(0).wait(1s));
}

TEST(SimulatedNetwork, AllocatesNothingOnceBuilt) {
  ManualClock clock;
  SimulatedNetwork network({}, clock);
  network.impair(bad_law());
  EXPECT_FALSE(network.link(1).join(kGroup));
  std::array<Datagram, 16> batch;
  std::size_t received = 0;
  const test::AllocationGuard guard;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    clock.advance(1ms);
    network.link(0).send(kGroup, octets_of(i));
    (void)network.link(1).join(kOther);
    network.link(1).leave(kOther);
    received += network.link(1).receive(batch);
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(received, 1000u);
}

}  // namespace
}  // namespace reckon::peer
