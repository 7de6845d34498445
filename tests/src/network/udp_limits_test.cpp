// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Errors of a UdpMulticast at limits of the kernel and for bad options.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <stdexcept>

#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

using namespace test;

TEST(UdpMulticast, NamesTheSysctlThatForbidsMemberships) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(
        test::run("ip link set lo up && "
                  "echo 0 > /proc/sys/net/ipv4/igmp_max_memberships"));
    UdpMulticast link(on("lo"), kClock);
    const std::error_code error = link.join(group(1));
    EXPECT_EQ(error, std::errc::no_buffer_space);
    EXPECT_NE(advice(error, group(1)).find("igmp_max_memberships"), std::string::npos);
    EXPECT_EQ(link.statistics().join_errors, 1u);
  });
}

TEST(UdpMulticast, ReturnsJoinErrorsAndGoesOn) {
  UdpMulticastOptions few = on("lo");
  few.max_groups = 2;
  UdpMulticast a(on("lo"), kClock), b(few, kClock);
  EXPECT_EQ(b.join(a.local_endpoint()), std::errc::invalid_argument);
  EXPECT_EQ(b.join(GroupPool::ipv6_default().base()), std::errc::invalid_argument);
  EXPECT_FALSE(b.join(group(1)));
  EXPECT_FALSE(b.join(group(2)));
  EXPECT_EQ(b.join(group(3)), std::errc::value_too_large);
  b.leave(group(1));
  EXPECT_FALSE(b.join(group(3)));
  ASSERT_TRUE(a.send(group(3), octets("x")));
  EXPECT_EQ(hear(b).size(), 1u);
  EXPECT_EQ(b.statistics().join_errors, 3u);
}

// UBSan inspects a vtable through a pipe of its own, for which no descriptor is left here.
[[gnu::no_sanitize("vptr")]] std::error_code join_without_descriptors(Link& link) {
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{3, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  const std::error_code error = link.join(group(1));
  setrlimit(RLIMIT_NOFILE, &before);
  return error;
}

TEST(UdpMulticast, ReturnsTooManyOpenFiles) {
  UdpMulticast link(on("lo"), kClock);
  const std::error_code error = join_without_descriptors(link);
  EXPECT_EQ(error, std::errc::too_many_files_open);
  EXPECT_NE(advice(error, group(1)).find("ulimit"), std::string::npos);
  EXPECT_FALSE(link.join(group(1)));
}

TEST(UdpMulticast, RefusesBadOptionsWithTheValue) {
  UdpMulticastOptions options = on("lo");
  options.ttl = 300;
  EXPECT_THROW(UdpMulticast(options, kClock), std::invalid_argument);
  options = on("lo");
  options.batch = 65;
  EXPECT_THROW(UdpMulticast(options, kClock), std::invalid_argument);
  EXPECT_THROW(UdpMulticast(on("none0"), kClock), std::runtime_error);
  UdpMulticast first(on("lo"), kClock);
  options = on("lo");
  options.unicast_port = first.local_endpoint().port;
  try {
    UdpMulticast second(options, kClock);
    FAIL() << "two links on one unicast port";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::address_in_use);
    EXPECT_NE(std::string(error.what()).find(first.local_endpoint().text()), std::string::npos);
  }
}

// How many of 2,000 datagrams the kernel keeps while nothing reads.
std::size_t kept(std::size_t receive_buffer, std::size_t size) {
  UdpMulticastOptions options = on("lo");
  options.receive_buffer = receive_buffer;
  UdpMulticast a(on("lo"), kClock), b(options, kClock);
  EXPECT_FALSE(b.join(group(1)));
  const std::vector<std::byte> update(size);
  for (int i = 0; i < 2000; ++i) EXPECT_TRUE(a.send(group(1), update));
  return hear(b).size();
}

TEST(ReceiveRoom, HoldsDatagramsWhileTheReaderIsStopped) {
  for (const std::size_t size : {1u, 144u, 208u, 512u, 1000u, 1400u, 1472u, 8192u}) {
    const std::size_t room = receive_room(40'000, std::chrono::milliseconds(50), size);
    EXPECT_EQ(kept(room, size), 2000u) << size;
  }
  const std::size_t room = receive_room(40'000, std::chrono::milliseconds(50), 1400);
  EXPECT_LT(kept(room / 2, 1400), 1100u) << "twice what is needed";
}

TEST(UdpMulticast, ReadsItsReceiveBufferBack) {
  UdpMulticast link(on("lo"), kClock);
  EXPECT_EQ(link.receive_buffer(), std::size_t{1} << 20);
  EXPECT_TRUE(link.warnings().empty());
}

}  // namespace
}  // namespace reckon::peer
