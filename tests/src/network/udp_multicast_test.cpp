// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_multicast.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <iostream>
#include <set>
#include <thread>
#include <vector>

#include "reckon/peer/threads/cpu_time.hpp"
#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// A socket of a program that does not set IP_MULTICAST_ALL.
int careless_socket(std::uint16_t port) {
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  const int yes = 1;
  setsockopt(handle, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_port = htons(port);
  EXPECT_EQ(bind(handle, reinterpret_cast<sockaddr*>(&any), sizeof any), 0);
  return handle;
}

int count_datagrams(int handle) {
  std::array<char, 64> buffer;
  int count = 0;
  while (recv(handle, buffer.data(), buffer.size(), 0) >= 0) ++count;
  return count;
}

TEST(UdpMulticast, CarriesADatagramFromOnePeerToAnother) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  ASSERT_TRUE(a.send(group(1), octets("hello")));
  ASSERT_TRUE(b.wait(1s));
  std::array<Datagram, 4> batch;
  ASSERT_EQ(b.receive(batch), 1u);
  EXPECT_EQ(text_of(batch[0]), "hello");
  EXPECT_EQ(batch[0].group, group(1));
  EXPECT_EQ(batch[0].sender, a.local_endpoint());
  EXPECT_EQ(a.statistics().sent, 1u);
  EXPECT_EQ(b.statistics().received_bytes, 5u);
}

TEST(UdpMulticast, DoesNotReceiveGroupsThatOnlyOthersJoined) {
  // The trap: a socket bound to the port alone receives every group that any process of this host
  // has joined.
  const int careless = careless_socket(group(0).port);
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock), sender(on("lo"), kClock);
  ASSERT_FALSE(a.join(group(1)));
  ASSERT_FALSE(b.join(group(2)));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(sender.send(group(2), octets("two")));
  EXPECT_EQ(hear(b).size(), 10u);
  EXPECT_TRUE(hear(a, 5ms).empty());
  EXPECT_EQ(count_datagrams(careless), 10) << "IP_MULTICAST_ALL is no trap on this kernel";
  close(careless);
}

TEST(UdpMulticast, ReceivesItsGroupOnItsOwnInterfaceOnly) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(
        test::bring_up("ip link set lo up && ip link add v0 type veth peer name v1 && "
                       "ip addr add 10.1.0.1/24 dev v0 && ip link set v0 up && "
                       "ip link set v1 up"));
    UdpMulticast on_lo(on("lo"), kClock), on_veth(on("v0"), kClock), sender(on("v0"), kClock);
    ASSERT_FALSE(on_lo.join(group(1)));
    ASSERT_FALSE(on_veth.join(group(1)));
    ASSERT_TRUE(sender.send(group(1), octets("veth")));
    EXPECT_EQ(hear(on_veth), std::vector<std::string>{"veth"});
    EXPECT_TRUE(hear(on_lo, 5ms).empty());
  });
}

TEST(UdpMulticast, LeavesAGroupAndJoinsItAgain) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  for (int round = 0; round < 3; ++round) {
    ASSERT_FALSE(b.join(group(1)));
    ASSERT_FALSE(b.join(group(1)));
    ASSERT_TRUE(a.send(group(1), octets("x")));
    EXPECT_EQ(hear(b).size(), 1u);
    b.leave(group(1));
    b.leave(group(1));
    ASSERT_TRUE(a.send(group(1), octets("y")));
    EXPECT_TRUE(hear(b, 5ms).empty());
  }
  EXPECT_EQ(b.statistics().joins, 3u);
  EXPECT_EQ(b.statistics().leaves, 3u);
}

TEST(UdpMulticast, JoinsThreeHundredGroups) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  const GroupPool pool(group(0), 300);
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const std::error_code error = b.join(pool.address(i));
    ASSERT_FALSE(error) << advice(error, pool.address(i));
  }
  std::set<std::size_t> heard;
  std::array<Datagram, 32> batch;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    ASSERT_TRUE(a.send(pool.address(i), octets("x")));
  }
  while (heard.size() < pool.size() && b.wait(200ms)) {
    const std::size_t count = b.receive(batch);
    for (std::size_t k = 0; k < count; ++k) heard.insert(pool.index(batch[k].group).value());
  }
  EXPECT_EQ(heard.size(), 300u);
}

// However many datagrams wait in some groups, the others get their turn.
TEST(UdpMulticast, ReadsEachGroupInTurnDuringFloods) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  for (std::uint8_t number = 1; number <= 3; ++number) ASSERT_FALSE(b.join(group(number)));
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(a.send(group(1), octets("flood")));
    ASSERT_TRUE(a.send(group(3), octets("flood")));
  }
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(a.send(group(2), octets("genuine")));
  std::array<Datagram, 32> batch;
  ASSERT_TRUE(b.wait(1s));
  std::ptrdiff_t genuine = 0;
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(b.receive(batch), batch.size());
    genuine += std::count_if(batch.begin(), batch.end(),
                             [](const Datagram& datagram) { return datagram.group == group(2); });
  }
  EXPECT_EQ(genuine, 10);
  EXPECT_EQ(hear(b).size(), 746u) << "nothing is left behind";
}

TEST(UdpMulticast, DoesNotReceiveItsOwnDatagramsUnlessConfigured) {
  UdpMulticastOptions deliver = on("lo");
  deliver.deliver_own = true;
  UdpMulticast deaf(on("lo"), kClock), hearing(deliver, kClock);
  ASSERT_FALSE(deaf.join(group(1)));
  ASSERT_FALSE(hearing.join(group(2)));
  ASSERT_TRUE(deaf.send(group(1), octets("me")));
  ASSERT_TRUE(hearing.send(group(2), octets("me")));
  EXPECT_TRUE(hear(deaf, 5ms).empty());
  EXPECT_EQ(deaf.statistics().own, 1u);
  EXPECT_EQ(hear(hearing).size(), 1u);
}

TEST(UdpMulticast, TakesUnicastOnItsOwnPort) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  EXPECT_NE(a.local_endpoint(), b.local_endpoint());
  ASSERT_TRUE(a.send(b.local_endpoint(), octets("to you")));
  ASSERT_TRUE(b.wait(1s));
  std::array<Datagram, 4> batch;
  ASSERT_EQ(b.receive(batch), 1u);
  EXPECT_EQ(batch[0].group, b.local_endpoint());
  EXPECT_TRUE(hear(a, 5ms).empty());
}

TEST(UdpMulticast, AllocatesNothingPerDatagram) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  std::array<Datagram, 32> batch;
  const std::array<std::byte, 144> update{};
  std::size_t received = 0;
  const test::AllocationGuard guard;
  for (int i = 0; i < 2000; ++i) {
    a.send(group(1), update);
    b.wait(10ms);
    received += b.receive(batch);
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_EQ(received, 2000u);
}

TEST(UdpMulticast, RefusesToFragment) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(test::bring_up(
        "ip link set lo up && ip link add v0 type veth peer name v1 && "
        "ip addr add 10.1.0.1/24 dev v0 && ip -6 addr add fd77::1/64 dev v0 nodad && "
        "ip link set v0 mtu 1400 up && ip link set v1 up"));
    ASSERT_TRUE(test::wait_for_ipv6("v0"));
    UdpMulticastOptions v6 = on("v0");
    v6.ipv6 = true;
    UdpMulticast a(on("v0"), kClock), b(v6, kClock);
    EXPECT_EQ(a.mtu(), 1400u);
    EXPECT_EQ(a.max_payload(), 1372u);
    EXPECT_EQ(b.max_payload(), 1352u);
    EXPECT_TRUE(a.send(group(1), std::vector<std::byte>(1372)));
    EXPECT_FALSE(a.send(group(1), std::vector<std::byte>(1373)));
    EXPECT_EQ(a.statistics().too_big, 1u);
    const GroupAddress group6 = GroupPool::ipv6_default().address(0);
    EXPECT_TRUE(b.send(group6, std::vector<std::byte>(1352)));
    EXPECT_FALSE(b.send(group6, std::vector<std::byte>(1353)));
    EXPECT_EQ(b.statistics().too_big, 1u);
  });
}

TEST(UdpMulticast, SpeaksIpv6) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(
        test::bring_up("ip link set lo up && ip link add v0 type veth peer name v1 && "
                       "ip -6 addr add fd77::1/64 dev v0 nodad && ip link set v0 up && "
                       "ip link set v1 up && ip -6 addr add fd78::1/64 dev v1 nodad"));
    ASSERT_TRUE(test::wait_for_ipv6("v0"));
    UdpMulticastOptions v6 = on("v0");
    v6.ipv6 = true;
    UdpMulticastOptions other_end = v6;
    other_end.interface = "v1";
    UdpMulticast a(v6, kClock), b(v6, kClock), c(other_end, kClock);
    const GroupPool pool = GroupPool::ipv6_default();
    for (std::size_t i = 0; i < pool.size(); ++i) ASSERT_FALSE(b.join(pool.address(i)));
    ASSERT_FALSE(a.join(pool.address(1)));
    ASSERT_TRUE(a.send(pool.address(3), octets("six")));
    ASSERT_TRUE(b.wait(1s));
    std::array<Datagram, 4> batch;
    ASSERT_EQ(b.receive(batch), 1u);
    EXPECT_EQ(batch[0].group, pool.address(3));
    EXPECT_EQ(batch[0].sender, a.local_endpoint());
    EXPECT_EQ(batch[0].sender.address_text(), "fd77::1");
    EXPECT_TRUE(hear(a, 5ms).empty());
    // Unicast to the sender's endpoint reaches it.
    ASSERT_TRUE(b.send(batch[0].sender, octets("back")));
    EXPECT_EQ(hear(a), std::vector<std::string>{"back"});
  });
}

TEST(UdpMulticast, ReachesTheLanByBroadcastWithoutMulticast) {
  RECKON_IN_OWN_NETWORK([] {
    test::make_cable();
    ASSERT_TRUE(test::bring_up(
        "ip link set a0 multicast off && ip link set b0 multicast off && "
        "cd /proc/sys/net/ipv4/conf && echo 1 > b0/accept_local && "
        "echo 0 > b0/rp_filter && echo 0 > all/rp_filter && "
        "ip link add c0 type veth peer name d0 && ip addr add 10.67.0.1/24 dev c0 && "
        "ip link set c0 up && ip link set d0 up"));
    const GroupAddress everybody = IpEndpoint::v4(0xffffffffu, group(0).port);
    UdpMulticastOptions near = on("a0"), far = on("b0"), elsewhere = on("c0");
    near.broadcast = far.broadcast = elsewhere.broadcast = true;
    UdpMulticast a(near, kClock), b(far, kClock), same_host(far, kClock), c(elsewhere, kClock);
    for (UdpMulticast* link : {&a, &b, &same_host, &c}) ASSERT_FALSE(link->join(everybody));
    const std::vector<std::string> sent{"one", "two", "end"};
    const std::array<OutgoingDatagram, 3> run{
        {{everybody, octets(sent[0])}, {everybody, octets(sent[1])}, {everybody, octets(sent[2])}}};
    EXPECT_EQ(a.send_batch(run).datagrams, 3u);
    EXPECT_EQ(hear(b), sent);
    EXPECT_EQ(hear(same_host), sent);
    EXPECT_TRUE(hear(a, 5ms).empty());
    EXPECT_EQ(a.statistics().own, 3u);
    EXPECT_TRUE(hear(c, 5ms).empty()) << "another interface";
    UdpMulticast careful(on("b0"), kClock);
    EXPECT_EQ(careful.join(everybody), std::errc::invalid_argument);
    EXPECT_FALSE(careful.send(everybody, octets("x")));
  });
}

TEST(UdpMulticast, CountsKernelDrops) {
  UdpMulticastOptions small = on("lo");
  small.receive_buffer = 4096;
  UdpMulticast a(on("lo"), kClock), b(small, kClock);
  ASSERT_FALSE(b.join(group(1)));
  const std::vector<std::byte> update(1000);
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(a.send(group(1), update));
  std::size_t received = hear(b).size();
  ASSERT_TRUE(a.send(group(1), update));  // carries the count
  received += hear(b).size();
  EXPECT_GT(b.statistics().kernel_drops, 0u);
  EXPECT_EQ(received + b.statistics().kernel_drops, 301u);
}

TEST(UdpMulticast, CountsDatagramsLongerThanItsBuffers) {
  UdpMulticastOptions small = on("lo");
  small.max_datagram = 100;
  UdpMulticast a(on("lo"), kClock), b(small, kClock);
  ASSERT_FALSE(b.join(group(1)));
  ASSERT_TRUE(a.send(group(1), std::vector<std::byte>(101)));
  ASSERT_TRUE(a.send(group(1), std::vector<std::byte>(100)));
  EXPECT_EQ(hear(b).size(), 1u);
  EXPECT_EQ(b.statistics().truncated, 1u);
}

TEST(UdpMulticast, ReportsWhenTheKernelReceivedADatagram) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  std::array<Datagram, 4> batch;
  nanoseconds age{0};
  // The kernel starts to add timestamps a moment after the first socket requests them.
  for (int attempt = 0; attempt < 50 && age < 2ms; ++attempt) {
    const nanoseconds sent = kClock.now();
    ASSERT_TRUE(a.send(group(1), octets("x")));
    while (kClock.now() - sent < 3ms) {
    }
    ASSERT_EQ(b.receive(batch), 1u);
    age = kClock.now() - batch[0].received;
    EXPECT_GE(age, 0ns);
  }
  EXPECT_GE(age, 2ms);
}

TEST(UdpMulticast, IsWokenFromAWait) {
  UdpMulticast link(on("lo"), kClock);
  link.wake();
  EXPECT_TRUE(link.wait(10s));  // a wake before the wait counts
  EXPECT_FALSE(link.wait(0ns));
  bool woken = false;
  std::thread reader([&] { woken = link.wait(20s); });
  const nanoseconds start = kClock.now();
  link.wake();
  reader.join();
  EXPECT_TRUE(woken);
  EXPECT_LT(kClock.now() - start, 5s);
}

TEST(UdpMulticast, KeepsAWakeAcrossAReceive) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  ASSERT_TRUE(a.send(group(1), octets("x")));
  b.wake();
  std::array<Datagram, 4> batch;
  EXPECT_EQ(b.receive(batch), 1u);
  EXPECT_TRUE(b.wait(10s));
}

// CPU time of this thread; on loopback it includes the kernel's work on the receiving side.
double cpu_ns() { return static_cast<double>(thread_cpu_time().count()); }

// Figures for docs/transport.md, not a criterion.
TEST(UdpMulticast, MeasuredCostOfADatagram) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  std::array<Datagram, 32> batch;
  for (const std::size_t size : {144u, 1352u}) {
    const std::vector<std::byte> update(size);
    constexpr int kRounds = 2000;
    std::size_t received = 0;
    const double start = cpu_ns();
    for (int round = 0; round < kRounds; ++round) {
      for (int i = 0; i < 32; ++i) a.send(group(1), update);
      while (const std::size_t count = b.receive(batch)) received += count;
    }
    std::cout << "send and receive of " << size
              << " octets, batches of 32: " << (cpu_ns() - start) / (kRounds * 32.0) << " ns CPU\n";
    EXPECT_EQ(received, kRounds * 32u);
  }
}

TEST(UdpMulticast, MeasuredCostOfJoining) {
  UdpMulticast link(on("lo"), kClock);
  const GroupPool pool(group(0), 300);
  const double start = cpu_ns();
  for (std::size_t i = 0; i < pool.size(); ++i) ASSERT_FALSE(link.join(pool.address(i)));
  const double joined = cpu_ns();
  for (std::size_t i = 0; i < pool.size(); ++i) link.leave(pool.address(i));
  std::cout << "join of one of 300 groups: " << (joined - start) / 300e3
            << " us CPU, leave: " << (cpu_ns() - joined) / 300e3 << " us CPU\n";
}

}  // namespace
}  // namespace reckon::peer
