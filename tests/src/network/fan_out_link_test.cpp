// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/fan_out_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/network/unicast_peers.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string refusal(const std::string& list) {
  try {
    static_cast<void>(parse_peers(list));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(UnicastPeers, AreReadWithAndWithoutPorts) {
  EXPECT_THAT(
      parse_peers("10.0.0.7, host-b:3001 ,2001:db8::7,[2001:db8::8]:3002,[::1]"),
      ElementsAre(NamedPeer{"10.0.0.7", 0}, NamedPeer{"host-b", 3001}, NamedPeer{"2001:db8::7", 0},
                  NamedPeer{"2001:db8::8", 3002}, NamedPeer{"::1", 0}));
}

TEST(UnicastPeers, AreWrittenAsTheyAreRead) {
  for (const char* text : {"10.0.0.7", "host-b:3001", "2001:db8::7", "[2001:db8::8]:3002"})
    EXPECT_EQ(parse_peer(text).text(), text);
}

TEST(UnicastPeers, AreRefusedByTheItemThatIsWrong) {
  EXPECT_THAT(refusal("10.0.0.7,,a"), HasSubstr("has no host"));
  EXPECT_THAT(refusal("10.0.0.7,:3000"), HasSubstr("':3000' has no host"));
  EXPECT_THAT(refusal("[[::]"), HasSubstr("is not an address in brackets"));
  EXPECT_THAT(refusal("host]:3001"), HasSubstr("bracket"));
  EXPECT_THAT(refusal("a:0"), HasSubstr("'a:0' has a port outside 1 to 65535"));
  EXPECT_THAT(refusal("a:70000"), HasSubstr("'a:70000'"));
  EXPECT_THAT(refusal("a:b"), HasSubstr("'a:b'"));
  EXPECT_THAT(refusal("[::1"), HasSubstr("brackets"));
  EXPECT_THAT(refusal("[::1]x"), HasSubstr("brackets"));
  EXPECT_THAT(refusal("[]:3000"), HasSubstr("brackets"));
  EXPECT_THAT(refusal("[a:b]"), HasSubstr("brackets"));
  EXPECT_THAT(refusal("a b"), HasSubstr("blank"));
  std::string many = "10.0.0.1";
  for (int i = 0; i < 256; ++i) many += ", 10.0.0.2";
  EXPECT_THAT(refusal(many), HasSubstr("more than 256"));
}

TEST(UnicastPeers, AreLookedUpOnceEach) {
  const auto found =
      resolve_peers(parse_peers("127.0.0.1, 127.0.0.1:3000, 127.0.0.1:3001"), 3000, false);
  EXPECT_THAT(found, ElementsAre(*IpEndpoint::parse("127.0.0.1:3000"),
                                 *IpEndpoint::parse("127.0.0.1:3001")));
  EXPECT_THAT(resolve_peers(parse_peers("::1"), 3000, true),
              ElementsAre(*IpEndpoint::parse("[::1]:3000")));
}

TEST(UnicastPeers, ThatAreNoHostAreNamed) {
  const auto why = [](const char* list, bool ipv6) {
    try {
      static_cast<void>(resolve_peers(parse_peers(list), 3000, ipv6));
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(why("no-such-host.invalid", false),
              HasSubstr("'no-such-host.invalid' has no IPv4 address"));
  EXPECT_THAT(why("127.0.0.1", true), HasSubstr("'127.0.0.1' has no IPv6 address"));
  EXPECT_THAT(why("239.192.1.0", false), HasSubstr("not the address of a single host"));
  EXPECT_THAT(why("255.255.255.255", false), HasSubstr("not the address of a single host"));
}

// Three hosts of one unicast list. Nothing joins on the network below, so it carries no multicast.
class FanOut : public testing::Test {
 protected:
  static constexpr std::size_t kHosts = 3;
  FanOut() {
    FanOutOptions options;
    for (std::size_t i = 0; i < kHosts; ++i)
      options.peers.push_back(network_.link(i).local_endpoint());
    for (std::size_t i = 0; i < kHosts; ++i)
      links_.push_back(std::make_unique<FanOutLink>(network_.link(i), pool_, options));
  }
  struct Heard {
    GroupAddress group;
    std::string text;
    friend bool operator==(const Heard&, const Heard&) = default;
  };
  std::vector<Heard> heard(std::size_t host) {
    std::vector<Heard> out;
    std::array<Datagram, 4> batch;
    while (const std::size_t count = links_[host]->receive(batch)) {
      for (std::size_t i = 0; i < count; ++i) out.push_back({batch[i].group, text_of(batch[i])});
    }
    return out;
  }

  static SimulatedNetworkOptions three() {
    SimulatedNetworkOptions options;
    options.links = kHosts;
    return options;
  }

  ManualClock clock_;
  SimulatedNetwork network_{three(), clock_};
  GroupPool pool_ = GroupPool::ipv4_default();
  std::vector<std::unique_ptr<FanOutLink>> links_;
};

TEST_F(FanOut, GoesToAllOfTheListButOneself) {
  for (auto& link : links_) static_cast<void>(link->join(pool_.base()));
  EXPECT_TRUE(links_[0]->send(pool_.base(), octets("hello")));
  EXPECT_THAT(heard(0), IsEmpty());
  EXPECT_THAT(heard(1), ElementsAre(Heard{pool_.base(), "hello"}));
  EXPECT_THAT(heard(2), ElementsAre(Heard{pool_.base(), "hello"}));
  EXPECT_EQ(links_[0]->statistics().sent, 2u);
}

TEST_F(FanOut, ReachesOnlyHostsThatJoinedItsGroup) {
  static_cast<void>(links_[1]->join(pool_.address(0)));
  static_cast<void>(links_[1]->join(pool_.address(255)));
  links_[0]->send(pool_.address(0), octets("a"));
  links_[0]->send(pool_.address(255), octets("b"));
  links_[0]->send(pool_.address(3), octets("c"));
  EXPECT_THAT(heard(1), ElementsAre(Heard{pool_.address(0), "a"}, Heard{pool_.address(255), "b"}));
  EXPECT_THAT(heard(2), IsEmpty());
  EXPECT_EQ(links_[1]->not_listened(), 1u);
  EXPECT_EQ(links_[2]->not_listened(), 3u);
  links_[1]->leave(pool_.address(0));
  links_[0]->send(pool_.address(0), octets("a"));
  EXPECT_THAT(heard(1), IsEmpty());
}

TEST_F(FanOut, OfABatchKeepsTheOrderForEach) {
  static_cast<void>(links_[2]->join(pool_.address(5)));
  std::vector<std::string> texts;
  for (int i = 0; i < 150; ++i) texts.push_back(std::to_string(i));
  std::vector<OutgoingDatagram> batch;
  for (const std::string& text : texts) batch.push_back({pool_.address(5), octets(text)});
  const SentBatch sent = links_[1]->send_batch(batch);
  EXPECT_EQ(sent.datagrams, 150u);
  std::vector<std::string> came;
  for (const Heard& one : heard(2)) came.push_back(one.text);
  EXPECT_EQ(came, texts);
}

TEST_F(FanOut, TakesUnframedDatagramsForTheBaseGroup) {
  static_cast<void>(links_[1]->join(pool_.base()));
  network_.link(0).send(links_[1]->local_endpoint(), octets("plain DIS"));
  EXPECT_THAT(heard(1), ElementsAre(Heard{pool_.base(), "plain DIS"}));
}

TEST_F(FanOut, InPlainDisPutsNothingInFront) {
  FanOutOptions options;
  options.peers = {network_.link(1).local_endpoint()};
  options.plain = true;
  FanOutLink plain(network_.link(0), pool_, options);
  EXPECT_TRUE(plain.send(pool_.base(), octets("as it is")));
  std::array<Datagram, 2> batch;
  ASSERT_EQ(network_.link(1).receive(batch), 1u);
  EXPECT_EQ(text_of(batch[0]), "as it is");
  EXPECT_EQ(plain.max_payload(), network_.link(0).max_payload());
}

TEST_F(FanOut, RandomOctetsArriveOnlyInJoinedGroups) {
  static_cast<void>(links_[1]->join(pool_.address(7)));
  std::mt19937 dice(1);
  std::vector<std::byte> noise;
  for (int i = 0; i < 20'000; ++i) {
    noise.resize(dice() % 40);
    for (std::byte& octet : noise) octet = static_cast<std::byte>(dice());
    if (noise.size() > 12 && i % 2 == 0) {  // as if they were a frame before a datagram
      noise[0] = std::byte{7}, noise[2] = std::byte{148}, noise[3] = std::byte{129};
      noise[8] = std::byte{0}, noise[9] = std::byte{16};
      if (noise.size() > 13 && i % 4 == 0) noise[12] = std::byte{0};
    }
    network_.link(0).send(links_[1]->local_endpoint(), noise);
    for (const Heard& one : heard(1)) EXPECT_EQ(one.group, pool_.address(7));
  }
  EXPECT_GT(links_[1]->not_listened(), 10'000u);
}

TEST_F(FanOut, SendsWithoutAllocation) {
  links_[0]->send(pool_.base(), octets("first"));
  AllocationGuard guard;
  links_[0]->send(pool_.base(), octets("second"));
  EXPECT_EQ(guard.count(), 0u);
}

// Segmentation by the kernel: the run to each address is one message where possible.
TEST(FanOutOverUdp, CarriesRunsToEachAddress) {
  const GroupPool pool = GroupPool::ipv4_default();
  UdpMulticast a(on("lo"), kClock), b(on("lo"), kClock), c(on("lo"), kClock);
  FanOutOptions options;
  options.peers = {a.local_endpoint(), b.local_endpoint(), c.local_endpoint()};
  FanOutLink from(a, pool, options), to_b(b, pool, options), to_c(c, pool, options);
  static_cast<void>(to_b.join(pool.address(1)));
  static_cast<void>(to_c.join(pool.address(1)));
  const std::string text(200, 'x');
  const std::vector<OutgoingDatagram> batch(20, {pool.address(1), octets(text)});
  EXPECT_EQ(from.send_batch(batch).datagrams, 20u);
  EXPECT_EQ(hear(to_b), std::vector<std::string>(20, text));
  EXPECT_EQ(hear(to_c), std::vector<std::string>(20, text));
  if (a.offload().segments) {
    EXPECT_EQ(a.statistics().send_calls, 1u);
  }
}

}  // namespace
}  // namespace reckon::peer
