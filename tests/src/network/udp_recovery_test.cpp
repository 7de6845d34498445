// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A UdpMulticast whose interface disappears and returns: two links at both ends of a cable, in a
// network namespace of their own.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

using namespace test;
using namespace std::chrono_literals;
using testing::Contains;
using testing::HasSubstr;

/// Lets the link check its host until `done`, at most 5 s; returns the events it reported.
template <typename Done>
std::vector<std::string> recover(Link& link, Done done) {
  std::vector<std::string> told;
  std::array<Datagram, 16> batch;
  LinkEvent event;
  for (const auto end = kClock.now() + 5s; kClock.now() < end && !done(told);) {
    link.wait(20ms);
    link.receive(batch);
    while (link.take_event(event)) told.emplace_back(event.text.data());
  }
  return told;
}

auto until_told(std::size_t sentences) {
  return [sentences](const std::vector<std::string>& told) { return told.size() >= sentences; };
}

/// True if the link receives its own datagrams from the group.
bool hears_itself(Link& link) {
  return recover(
             link,
             [&](const auto&) {
               static_cast<void>(link.send(group(1), octets("x")));
               return link.statistics().own > 0;
             }).size() < 100 &&
         link.statistics().own > 0;
}

TEST(UdpRecovery, RejoinsGroupsOnARecreatedInterface) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("a0"), kClock);
    ASSERT_FALSE(link.join(group(1)));
    ASSERT_FALSE(link.join(group(2)));
    const IpEndpoint before = link.local_endpoint();
    ASSERT_TRUE(test::run("ip link delete a0"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("a0 is gone")));
    EXPECT_FALSE(link.send(group(1), octets("x")));
    EXPECT_NE(link.statistics().last_send_error, 0);

    make_cable();
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("2 groups joined again")));
    EXPECT_EQ(link.local_endpoint(), before);
    EXPECT_TRUE(hears_itself(link));
    EXPECT_EQ(link.statistics().interface_losses, 1u);
    EXPECT_EQ(link.statistics().recoveries, 1u);
    EXPECT_EQ(link.statistics().join_errors, 0u);
  });
}

TEST(UdpRecovery, KeepsItsPortAtANewAddress) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("a0"), kClock);
    ASSERT_FALSE(link.join(group(1)));
    const std::uint16_t port = link.local_endpoint().port;
    ASSERT_TRUE(test::run("ip addr add 10.66.0.9/25 dev a0 && ip addr delete 10.66.0.1/24 dev a0"));
    EXPECT_THAT(
        recover(link,
                [&](const auto&) { return link.local_endpoint().address_text() == "10.66.0.9"; }),
        Contains(HasSubstr("10.66.0.9")));
    EXPECT_EQ(link.local_endpoint().port, port);
    EXPECT_TRUE(hears_itself(link));

    // Unicast reaches it at the new address.
    UdpMulticast other(on("b0"), kClock);
    ASSERT_TRUE(other.send(link.local_endpoint(), octets("to you")));
    EXPECT_THAT(hear(link, 200ms), Contains("to you"));
  });
}

TEST(UdpRecovery, TakesAnotherPortWhereItsOwnIsTaken) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("a0"), kClock);
    UdpMulticastOptions same = on("b0");
    same.unicast_port = link.local_endpoint().port;
    const UdpMulticast holder(same, kClock);
    ASSERT_TRUE(test::run("ip addr delete 10.66.0.1/24 dev a0 && ip addr add 10.66.0.2/25 dev a0"));
    const auto told = recover(link, until_told(2));
    EXPECT_THAT(told, Contains(HasSubstr("is taken, ours is")));
    EXPECT_EQ(link.local_endpoint().address_text(), "10.66.0.2");
    EXPECT_NE(link.local_endpoint().port, holder.local_endpoint().port);
  });
}

TEST(UdpRecovery, ReportsTheStateOfTheInterface) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("a0"), kClock);
    ASSERT_TRUE(test::run("ip link set b0 down"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("a0 has no carrier")));
    ASSERT_TRUE(test::run("ip link set b0 up"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("works again")));
    ASSERT_TRUE(test::run("ip link set a0 down"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("a0 is down")));
    ASSERT_TRUE(test::run("ip link set a0 up"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("works again")));
    ASSERT_TRUE(test::run("ip addr flush dev a0"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("a0 has no IPv4 address")));
  });
}

/// The events that a link reports in a second.
std::vector<std::string> told_in_a_second(Link& link) {
  const auto end = kClock.now() + 1s;
  return recover(link, [end](const auto&) { return kClock.now() >= end; });
}

TEST(UdpRecovery, ReportsAMissingDescriptorOnce) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "without descriptors the sanitizer takes each object for one of another type";
#endif
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("a0"), kClock);
    ASSERT_FALSE(link.join(group(1)));
    ASSERT_TRUE(test::run("ip addr add 10.66.0.9/25 dev a0 && ip addr delete 10.66.0.1/24 dev a0"));
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit none{3, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    const auto told = told_in_a_second(link);  // more than two tries
    EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
    ASSERT_EQ(told.size(), 1u) << testing::PrintToString(told);
    EXPECT_THAT(told[0], HasSubstr("cannot read the state of interface a0"));
    EXPECT_THAT(told[0], HasSubstr("ulimit -n"));

    EXPECT_THAT(recover(link, until_told(2)), Contains(HasSubstr("a0 can be read again")));
    EXPECT_EQ(link.local_endpoint().address_text(), "10.66.0.9");
    EXPECT_TRUE(hears_itself(link));
  });
}

TEST(UdpRecovery, WaitsForTheRequestedAddressOnAnyInterface) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("10.66.0.1"), kClock);
    ASSERT_FALSE(link.join(group(1)));
    ASSERT_TRUE(test::run("ip addr delete 10.66.0.1/24 dev a0"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("has lost its address")));
    ASSERT_TRUE(test::run("ip addr delete 10.66.0.2/24 dev b0 && ip addr add 10.66.0.1/24 dev b0"));
    EXPECT_THAT(recover(link, until_told(1)), Contains(HasSubstr("interface b0 in place of a0")));
    EXPECT_TRUE(hears_itself(link));
  });
}

// The writing thread never uses a closed socket or another thread's descriptor.
TEST(UdpRecovery, SendsGoOnInAnotherThreadMeanwhile) {
  RECKON_IN_OWN_NETWORK([] {
    make_cable();
    UdpMulticast link(on("a0"), kClock);
    ASSERT_FALSE(link.join(group(1)));
    std::atomic<bool> stop{false};
    std::atomic<int> last_bad{0};
    std::thread writer([&] {
      while (!stop) {
        if (!link.send(group(1), octets("x")) && link.statistics().last_send_error == EBADF) {
          last_bad = EBADF;
        }
      }
    });
    for (int i = 0; i < 5; ++i) {
      const std::string next = "10.66.0." + std::to_string(20 + i);
      const std::string last = i == 0 ? "10.66.0.1" : "10.66.0." + std::to_string(19 + i);
      EXPECT_TRUE(test::run(
          ("ip addr delete " + last + "/24 dev a0 && ip addr add " + next + "/24 dev a0").c_str()));
      recover(link, [&](const auto&) { return link.local_endpoint().address_text() == next; });
      EXPECT_EQ(link.local_endpoint().address_text(), next);
    }
    stop = true;
    writer.join();
    EXPECT_EQ(last_bad, 0);
    EXPECT_TRUE(hears_itself(link));
  });
}

}  // namespace
}  // namespace reckon::peer
