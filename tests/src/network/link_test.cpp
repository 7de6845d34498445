// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/link.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <unordered_set>

namespace reckon::peer {
namespace {

TEST(IpEndpoint, ReadsItsOwnText) {
  for (const char* text : {"239.192.1.0:3000", "0.0.0.0:0", "255.255.255.255:65535",
                           "[ff15::c0:100]:3000", "[::1]:1", "[fe80::1]:3000"}) {
    const auto endpoint = IpEndpoint::parse(text);
    ASSERT_TRUE(endpoint) << text;
    EXPECT_EQ(endpoint->text(), text);
  }
}

TEST(IpEndpoint, TakesTheDefaultPortWhereNoneIsGiven) {
  EXPECT_EQ(IpEndpoint::parse("239.1.2.3", 3000)->text(), "239.1.2.3:3000");
  EXPECT_EQ(IpEndpoint::parse("ff15::1", 3000)->text(), "[ff15::1]:3000");
  EXPECT_EQ(IpEndpoint::parse("[ff15::1]", 3000)->text(), "[ff15::1]:3000");
}

TEST(IpEndpoint, RefusesTextThatIsNoAddress) {
  for (const char* text :
       {"", "239.1.2", "239.1.2.3.4", "239.1.2.3:", "239.1.2.3:x", "host", "239.1.2.3:70000",
        "[ff15::1", "[ff15::1]3000", "::1:::", "1.2.3.4:1 "}) {
    EXPECT_FALSE(IpEndpoint::parse(text)) << text;
  }
}

TEST(IpEndpoint, KnowsMulticastAndLoopback) {
  EXPECT_TRUE(IpEndpoint::parse("224.0.0.1")->is_multicast());
  EXPECT_TRUE(IpEndpoint::parse("239.255.255.255")->is_multicast());
  EXPECT_FALSE(IpEndpoint::parse("240.0.0.1")->is_multicast());
  EXPECT_TRUE(IpEndpoint::parse("ff15::1")->is_multicast());
  EXPECT_FALSE(IpEndpoint::parse("fe80::1")->is_multicast());
  EXPECT_TRUE(IpEndpoint::parse("127.1.2.3")->is_loopback());
  EXPECT_TRUE(IpEndpoint::parse("::1")->is_loopback());
  EXPECT_FALSE(IpEndpoint::parse("::2")->is_loopback());
  EXPECT_TRUE(IpEndpoint{}.is_unspecified());
}

TEST(GroupPool, FollowsItsBaseGroup) {
  const GroupPool pool = GroupPool::ipv4_default();
  EXPECT_EQ(pool.base().text(), "239.192.1.0:3000");
  EXPECT_EQ(pool.address(0).text(), "239.192.1.1:3000");
  EXPECT_EQ(pool.address(255).text(), "239.192.2.0:3000");
  EXPECT_EQ(GroupPool::ipv6_default().base().text(), "[ff15::c0:100]:3000");
  EXPECT_EQ(GroupPool::ipv6_default().address(255).text(), "[ff15::c0:200]:3000");
}

TEST(GroupPool, FindsTheIndexOfItsGroupsOnly) {
  for (const GroupPool& pool : {GroupPool::ipv4_default(), GroupPool::ipv6_default()}) {
    std::unordered_set<IpEndpoint> all;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      EXPECT_EQ(pool.index(pool.address(i)), i);
      all.insert(pool.address(i));
    }
    EXPECT_EQ(all.size(), pool.size());
    EXPECT_FALSE(pool.index(pool.base()));
    GroupAddress other_port = pool.address(3);
    other_port.port = 3001;
    EXPECT_FALSE(pool.index(other_port));
  }
  EXPECT_FALSE(GroupPool::ipv4_default().index(*IpEndpoint::parse("239.192.2.1:3000")));
  EXPECT_FALSE(GroupPool::ipv4_default().index(*IpEndpoint::parse("[ff15::c0:101]:3000")));
  EXPECT_FALSE(GroupPool::ipv6_default().index(*IpEndpoint::parse("[ff05::c0:101]:3000")));
}

TEST(GroupPool, HasNoGroupsBehindTheBroadcastAddress) {
  const IpEndpoint everybody = IpEndpoint::v4(0xffffffffu, 3000);
  EXPECT_TRUE(everybody.is_broadcast());
  EXPECT_FALSE(IpEndpoint::v4(0xffffff00u, 3000).is_broadcast());
  EXPECT_FALSE(IpEndpoint::parse("[ffff:ffff::1]:3000")->is_broadcast());
  const GroupPool pool(everybody, 256);
  EXPECT_EQ(pool.base(), everybody);
  EXPECT_FALSE(pool.index(everybody));
  EXPECT_FALSE(pool.index(IpEndpoint::v4(0, 3000)));
  EXPECT_THROW(GroupPool(IpEndpoint::v4(0xffffffffu, 0), 256), std::invalid_argument);
}

TEST(GroupPool, RefusesAddressesOutsideTheMulticastRange) {
  const auto endpoint = [](const char* text) { return *IpEndpoint::parse(text); };
  EXPECT_THROW(GroupPool(endpoint("10.0.0.1:3000"), 4), std::invalid_argument);
  EXPECT_THROW(GroupPool(endpoint("239.1.1.1"), 4), std::invalid_argument);
  EXPECT_THROW(GroupPool(endpoint("239.1.1.1:3000"), 0), std::invalid_argument);
  EXPECT_THROW(GroupPool(endpoint("239.1.1.1:3000"), 65536), std::invalid_argument);
  EXPECT_THROW(GroupPool(endpoint("239.255.255.250:3000"), 6), std::invalid_argument);
  EXPECT_NO_THROW(GroupPool(endpoint("239.255.255.250:3000"), 5));
  const GroupPool subnet(endpoint("10.9.9.255:3000"), 4);
  EXPECT_FALSE(subnet.index(endpoint("10.9.10.0:3000")).has_value()) << "it has no groups";
}

TEST(Advice, NamesTheLimitThatWasHit) {
  const GroupAddress group = GroupPool::ipv4_default().base();
  const auto text = [&](std::errc code) { return advice(std::make_error_code(code), group); };
  EXPECT_NE(text(std::errc::no_buffer_space).find("igmp_max_memberships"), std::string::npos);
  EXPECT_NE(text(std::errc::too_many_files_open).find("ulimit -n"), std::string::npos);
  EXPECT_NE(text(std::errc::no_such_device).find("--iface"), std::string::npos);
  EXPECT_NE(text(std::errc::no_such_device).find("239.192.1.0:3000"), std::string::npos);
}

}  // namespace
}  // namespace reckon::peer
