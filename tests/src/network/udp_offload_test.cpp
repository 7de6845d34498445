// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Batches of datagrams with segmentation offload: each arrives as it was sent.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/udp_send_batch.hpp"
#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;

UdpMulticastOptions with_offload(const char* interface, bool offload) {
  UdpMulticastOptions options = on(interface);
  options.offload = offload;
  return options;
}

// Datagrams that differ in every octet, so that none can be mistaken for another.
struct Traffic {
  std::vector<std::string> texts;
  std::vector<OutgoingDatagram> batch;

  void add(const IpEndpoint& to, std::size_t size) {
    std::string text(size, '\0');
    for (std::size_t i = 0; i < size; ++i)
      text[i] = static_cast<char>((texts.size() * 131 + i * 7 + i / 251) & 0xff);
    texts.push_back(std::move(text));
    where.push_back(to);
  }
  // Call it once all are added: the texts no longer move.
  std::span<const OutgoingDatagram> whole() {
    batch.clear();
    for (std::size_t i = 0; i < texts.size(); ++i) batch.push_back({where[i], octets(texts[i])});
    return batch;
  }
  [[nodiscard]] std::vector<std::string> sent_to(const IpEndpoint& to) const {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (where[i] == to) out.push_back(texts[i]);
    }
    return out;
  }
  std::vector<IpEndpoint> where;
};

std::map<IpEndpoint, std::vector<std::string>> hear_by_group(Link& link) {
  std::map<IpEndpoint, std::vector<std::string>> out;
  std::array<Datagram, 7> batch;  // shorter than a run, so that runs wait for the next call
  while (link.wait(50ms)) {
    const std::size_t count = link.receive(batch);
    for (std::size_t i = 0; i < count; ++i) out[batch[i].group].push_back(text_of(batch[i]));
  }
  return out;
}

Traffic mixed(const std::vector<GroupAddress>& groups, std::size_t longest) {
  Traffic traffic;
  std::mt19937 random(7);
  const std::array<std::size_t, 6> sizes{1, 144, 145, 1000, longest - 1, longest};
  while (traffic.texts.size() < 400) {
    const GroupAddress& to = groups[random() % groups.size()];
    const std::size_t size = sizes[random() % sizes.size()];
    for (std::size_t left = 1 + random() % 90; left > 0; --left) traffic.add(to, size);
    if (random() % 2 == 0) traffic.add(to, 1 + random() % size);
    if (random() % 4 == 0) traffic.add(to, 0);
  }
  return traffic;
}

// Links that send with and without segmentation reach links that receive runs whole and one by one.
void expect_equal_octets(const UdpMulticastOptions& plain, const std::string& far,
                         const std::vector<GroupAddress>& groups) {
  for (const bool cuts : {false, true}) {
    UdpMulticastOptions sending = plain, whole = plain, single = plain;
    sending.offload = cuts;
    whole.interface = single.interface = far;
    single.offload = false;
    whole.receive_buffer = single.receive_buffer = std::size_t{8} << 20;
    UdpMulticast a(sending, kClock), b(whole, kClock), c(single, kClock);
    for (const GroupAddress& group : groups) {
      ASSERT_FALSE(b.join(group));
      ASSERT_FALSE(c.join(group));
    }
    Traffic traffic = mixed(groups, std::min<std::size_t>(a.max_payload(), 1472));
    const SentBatch sent = a.send_batch(traffic.whole());
    EXPECT_EQ(sent.datagrams, traffic.texts.size());
    EXPECT_EQ(sent.octets, a.statistics().sent_bytes);
    auto heard = hear_by_group(b), heard_singly = hear_by_group(c);
    for (const GroupAddress& group : groups) {
      // Compared as a whole: a difference would be too long to print.
      EXPECT_TRUE(heard[group] == traffic.sent_to(group)) << group.text() << " cut: " << cuts;
      EXPECT_TRUE(heard_singly[group] == traffic.sent_to(group))
          << group.text() << " cut: " << cuts;
    }
    EXPECT_EQ(b.statistics().received, sent.datagrams);
    EXPECT_EQ(b.statistics().received_bytes, sent.octets);
    EXPECT_EQ(a.offload().segments, cuts);
    EXPECT_EQ(b.offload().coalesces, plain.offload);
  }
}

// From a0 with an MTU of 1400 to b0, which accepts a source address of its own host.
void make_open_cable() {
  test::make_cable();
  ASSERT_TRUE(
      test::run("ip link set a0 mtu 1400 && cd /proc/sys/net/ipv4/conf && "
                "echo 1 > b0/accept_local && echo 0 > b0/rp_filter && echo 0 > all/rp_filter"));
}

TEST(UdpOffload, CarriesEqualOctetsOnLoopback) {
  expect_equal_octets(on("lo"), "lo", {group(1), group(2), group(3)});
}

TEST(UdpOffload, CarriesEqualOctetsAtAnMtuOf1400) {
  RECKON_IN_OWN_NETWORK([] {
    make_open_cable();
    ASSERT_TRUE(test::run("ip link set b0 mtu 1400"));
    expect_equal_octets(on("a0"), "b0", {group(1), group(2), group(3)});
  });
}

TEST(UdpOffload, CarriesTheSameOctetsOverIpv6) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(
        test::bring_up("ip link set lo up && ip link add v0 type veth peer name v1 && "
                       "ip link set v0 mtu 1400 up && ip link set v1 mtu 1400 up && "
                       "ip -6 addr add fd77::1/64 dev v0 nodad && "
                       "ip -6 addr add fd78::1/64 dev v1 nodad"));
    ASSERT_TRUE(test::wait_for_ipv6("v0"));
    UdpMulticastOptions v6 = on("v0");
    v6.ipv6 = true;
    const GroupPool pool = GroupPool::ipv6_default();
    expect_equal_octets(v6, "v1", {pool.address(0), pool.address(1)});
  });
}

TEST(UdpOffload, SendsABatchWithOneCall) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  ASSERT_FALSE(b.join(group(2)));
  Traffic traffic;
  for (int i = 0; i < 30; ++i) traffic.add(group(1), 1300);
  traffic.add(group(1), 700);
  for (int i = 0; i < 33; ++i) traffic.add(i % 2 == 0 ? group(1) : group(2), 100);
  EXPECT_EQ(a.send_batch(traffic.whole()).datagrams, 64u);
  EXPECT_EQ(a.statistics().send_calls, 1u);
  EXPECT_EQ(hear(b).size(), 64u);
}

TEST(UdpOffload, AllocatesNothing) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  Traffic traffic;
  for (int i = 0; i < 64; ++i) traffic.add(group(1), i % 20 == 0 ? 300 : 1000);
  const auto batch = traffic.whole();
  std::array<Datagram, 32> out;
  std::size_t received = 0;
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    a.send_batch(batch);
    while (b.wait(0ns)) received += b.receive(out);
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_EQ(received, 6400u);
}

TEST(UdpOffload, ReadsEachGroupInTurnDuringRuns) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  for (std::uint8_t number = 1; number <= 3; ++number) ASSERT_FALSE(b.join(group(number)));
  Traffic flood;
  for (int i = 0; i < 64; ++i) flood.add(group(1), 500);
  std::array<Datagram, 64> out;
  a.send_batch(flood.whole());  // from now on group 1 is known to bring runs
  while (b.wait(0ns)) static_cast<void>(b.receive(out));
  for (int i = 0; i < 20; ++i) a.send_batch(flood.whole());
  ASSERT_TRUE(a.send(group(2), octets("genuine")));
  std::size_t before = 0;
  for (bool found = false; !found; ++before) {
    ASSERT_TRUE(b.wait(0ns)) << "not heard";
    const std::size_t count = b.receive(out);
    found = std::any_of(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count),
                        [](const Datagram& datagram) { return datagram.group == group(2); });
  }
  EXPECT_LE(before, 3u) << "calls of 64 datagrams";
}

TEST(UdpOffload, DoesNotReceiveItsOwnRuns) {
  UdpMulticastOptions hearing = on("lo");
  hearing.deliver_own = true;
  UdpMulticast deaf(on("lo"), kClock), other(hearing, kClock);
  ASSERT_FALSE(deaf.join(group(1)));
  ASSERT_FALSE(other.join(group(2)));
  Traffic traffic;
  for (int i = 0; i < 10; ++i) traffic.add(group(1), 50);
  deaf.send_batch(traffic.whole());
  EXPECT_TRUE(hear(deaf, 5ms).empty());
  EXPECT_EQ(deaf.statistics().own, 10u);
  for (IpEndpoint& to : traffic.where) to = group(2);
  other.send_batch(traffic.whole());
  EXPECT_EQ(hear(other), traffic.texts);
}

TEST(UdpOffload, CountsRunsOfDatagramsThatAreTooLong) {
  UdpMulticastOptions small = on("lo");
  small.max_datagram = 100;
  UdpMulticast a(on("lo"), kClock), b(small, kClock);
  ASSERT_FALSE(b.join(group(1)));
  Traffic traffic;
  for (int i = 0; i < 5; ++i) traffic.add(group(1), 101);
  for (int i = 0; i < 3; ++i) traffic.add(group(1), 100);
  a.send_batch(traffic.whole());
  // A last datagram of 100 octets belongs to the run of datagrams of 101 octets.
  EXPECT_EQ(hear(b).size() + b.statistics().truncated, 8u);
  EXPECT_GE(b.statistics().truncated, 5u);
}

TEST(UdpOffload, ReturnsNothingOfALeftGroup) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  Traffic traffic;
  for (int i = 0; i < 10; ++i) traffic.add(group(1), 50);
  a.send_batch(traffic.whole());
  std::array<Datagram, 4> out;
  ASSERT_TRUE(b.wait(1s));
  ASSERT_EQ(b.receive(out), 4u);
  b.leave(group(1));
  EXPECT_EQ(b.receive(out), 0u);
  EXPECT_FALSE(b.wait(0ns));
}

TEST(UdpOffload, RefusesOnlyDatagramsAboveTheMtu) {
  RECKON_IN_OWN_NETWORK([] {
    make_open_cable();
    UdpMulticast a(on("a0"), kClock), b(on("b0"), kClock);
    ASSERT_FALSE(b.join(group(1)));
    Traffic traffic;
    for (int i = 0; i < 3; ++i) traffic.add(group(1), 1373);
    for (int i = 0; i < 3; ++i) traffic.add(group(1), 1372);
    EXPECT_EQ(a.send_batch(traffic.whole()).datagrams, 3u);
    EXPECT_EQ(a.statistics().too_big, 3u);
    EXPECT_TRUE(a.offload().segments);
    EXPECT_EQ(hear(b).size(), 3u);
  });
}

// The descriptor of a link's sending socket, found by its port.
int sending_socket(const UdpMulticast& link) {
  for (int handle = 3; handle < 256; ++handle) {
    sockaddr_in bound{};
    socklen_t size = sizeof bound;
    if (getsockname(handle, reinterpret_cast<sockaddr*>(&bound), &size) == 0 &&
        bound.sin_family == AF_INET && ntohs(bound.sin_port) == link.local_endpoint().port)
      return handle;
  }
  return -1;
}

TEST(UdpOffload, SendsSinglyWhereTheKernelRefusesToSegment) {
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock);
  ASSERT_FALSE(b.join(group(1)));
  // The kernel does not segment on a socket without checksums.
  const int off = 1;
  ASSERT_EQ(setsockopt(sending_socket(a), SOL_SOCKET, SO_NO_CHECK, &off, sizeof off), 0);
  Traffic traffic;
  for (int i = 0; i < 20; ++i) traffic.add(group(1), 200);
  EXPECT_EQ(a.send_batch(traffic.whole()).datagrams, 20u);
  EXPECT_FALSE(a.offload().segments);
  EXPECT_EQ(a.offload().refusal, EINVAL);
  EXPECT_EQ(a.statistics().send_errors, 0u);
  EXPECT_EQ(hear(b), traffic.texts);
  a.wait(0ns);
  LinkEvent event;
  ASSERT_TRUE(a.take_event(event));
  EXPECT_NE(std::string(event.text.data()).find("UDP_SEGMENT"), std::string::npos);
  EXPECT_FALSE(a.take_event(event));
  // It does not try again, and still needs one call.
  const std::uint64_t calls = a.statistics().send_calls;
  EXPECT_EQ(a.send_batch(traffic.whole()).datagrams, 20u);
  EXPECT_EQ(a.statistics().send_calls - calls, 1u);
  EXPECT_EQ(hear(b), traffic.texts);
}

TEST(UdpOffload, IsOffWhereItIsNotWanted) {
  UdpMulticast link(with_offload("lo", false), kClock);
  EXPECT_FALSE(link.offload().segments);
  EXPECT_FALSE(link.offload().coalesces);
  EXPECT_EQ(link.offload().refusal, 0);
  EXPECT_TRUE(link.warnings().empty());
}

TEST(SegmentRun, EndsAtAnotherGroupOrSize) {
  const std::vector<std::byte> room(40000);
  const auto of = [&](std::uint8_t number, std::size_t size) {
    return OutgoingDatagram{group(number), std::span(room).first(size)};
  };
  using Batch = std::vector<OutgoingDatagram>;
  EXPECT_EQ(segment_run(Batch{of(1, 9)}, 1400), 1u);
  EXPECT_EQ(segment_run(Batch{of(1, 9), of(1, 9), of(2, 9)}, 1400), 2u);
  EXPECT_EQ(segment_run(Batch{of(1, 9), of(1, 9), of(1, 10)}, 1400), 2u);
  EXPECT_EQ(segment_run(Batch{of(1, 9), of(1, 5), of(1, 5)}, 1400), 2u);
  EXPECT_EQ(segment_run(Batch{of(1, 9), of(1, 0), of(1, 9)}, 1400), 1u);
  EXPECT_EQ(segment_run(Batch{of(1, 0), of(1, 0)}, 1400), 1u);
  EXPECT_EQ(segment_run(Batch{of(1, 1401), of(1, 1401)}, 1400), 1u);
  EXPECT_EQ(segment_run(Batch(70, of(1, 9)), 1400), 64u);
  EXPECT_EQ(segment_run(Batch(64, of(1, 1400)), 1400), 46u) << "no longer than one IP packet";
}

}  // namespace
}  // namespace reckon::peer
