// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/host_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer::host_limits_test {
namespace {

using namespace std::chrono_literals;

const GroupAddress kGroup = GroupPool::ipv4_default().base();

NetworkInterface interface_named(std::string_view name) {
  for (const NetworkInterface& interface : list_interfaces()) {
    if (interface.name == name) return interface;
  }
  return {};
}

// A very busy machine may miss the limit of 100 ms.
Finding probe_up_to_five_times(const NetworkInterface& interface,
                               const GroupAddress& group = kGroup) {
  Finding finding = probe_multicast(interface, group);
  for (int i = 0; i < 4 && finding.level != FindingLevel::ok; ++i) {
    finding = probe_multicast(interface, group);
  }
  return finding;
}

TEST(HostLimits, ReceiveOwnMulticastOnLoopback) {
  const Finding finding = probe_up_to_five_times(interface_named("lo"));
  EXPECT_EQ(finding.level, FindingLevel::ok) << finding.what;
  EXPECT_NE(finding.what.find("own datagram back after"), std::string::npos);
}

TEST(HostLimits, LookAtTheListOfAScene) {
  const auto port = static_cast<std::uint16_t>(20000 + getpid() % 20000);
  const GroupAddress group = IpEndpoint::v4(0xefc04d01, port);
  const NetworkInterface lo = interface_named("lo");
  const Finding in_it = probe_peers(lo, parse_peers("127.0.0.1, 127.0.0.2"), group);
  EXPECT_EQ(in_it.level, FindingLevel::ok) << in_it.what;
  EXPECT_NE(in_it.what.find("the list of 2 peers can be sent to"), std::string::npos);
  const Finding out = probe_peers(lo, parse_peers("127.0.0.2"), group);
  EXPECT_EQ(out.level, FindingLevel::note) << out.what;
  EXPECT_NE(out.what.find("is not in it"), std::string::npos);
  const Finding unknown = probe_peers(lo, parse_peers("no-such-host.invalid"), group);
  EXPECT_EQ(unknown.level, FindingLevel::problem);
  EXPECT_NE(unknown.what.find("'no-such-host.invalid'"), std::string::npos) << unknown.what;
}

TEST(HostLimits, CallAnInterfaceWithoutAddressAProblem) {
  NetworkInterface none;
  none.name = "none0";
  const Finding finding = probe_multicast(none, kGroup);
  EXPECT_EQ(finding.level, FindingLevel::problem);
  EXPECT_NE(finding.remedy.find("--iface"), std::string::npos);
}

TEST(HostLimits, FindAProgramThatHoldsThePort) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(test::run("ip link set lo up"));
    const int holder = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_port = htons(kGroup.port);
    ASSERT_EQ(bind(holder, reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
    const Finding held = probe_multicast(interface_named("lo"), kGroup);
    close(holder);
    EXPECT_EQ(held.level, FindingLevel::problem);
    EXPECT_NE(held.what.find("another program uses the port"), std::string::npos) << held.what;
    GroupAddress elsewhere = kGroup;
    elsewhere.port = 3001;
    EXPECT_EQ(probe_up_to_five_times(interface_named("lo"), elsewhere).level, FindingLevel::ok);
  });
}

TEST(HostLimits, FindAFirewallOnThePort) {
  if (!test::run("command -v nft >/dev/null")) GTEST_SKIP() << "needs nft (Debian: nftables)";
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(test::run("ip link set lo up"));
    ASSERT_TRUE(
        test::run("nft 'table inet t { chain c { type filter hook input priority 0; udp dport 3000 "
                  "drop; }; }'"));
    const Finding dropped = probe_multicast(interface_named("lo"), kGroup);
    EXPECT_EQ(dropped.level, FindingLevel::problem);
    EXPECT_NE(dropped.what.find("not back"), std::string::npos) << dropped.what;
    EXPECT_NE(dropped.remedy.find("nft list ruleset"), std::string::npos);
    ASSERT_TRUE(
        test::run("nft flush ruleset && nft 'table inet t { chain c { type filter hook output "
                  "priority 0; udp dport 3000 drop; }; }'"));
    const Finding refused = probe_multicast(interface_named("lo"), kGroup);
    EXPECT_EQ(refused.level, FindingLevel::problem);
    EXPECT_NE(refused.what.find("Operation not permitted"), std::string::npos) << refused.what;
  });
}

TEST(HostLimits, CountTheGroupsThatCanBeJoined) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "without descriptors the sanitizer takes each object for one of another type";
#endif
  const GroupPool pool(test::group(100), 40);
  EXPECT_EQ(probe_groups(interface_named("lo"), pool, 40).level, FindingLevel::ok);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit few{30, 30};
    setrlimit(RLIMIT_NOFILE, &few);
    const Finding found = probe_groups(interface_named("lo"), pool, 40);
    const bool right =
        found.level == FindingLevel::problem &&
        found.what.find("could be joined, then: Too many open files") != std::string::npos &&
        found.remedy.find("ulimit -n") != std::string::npos;
    _exit(right ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(HostLimits, FindAMissingMulticastRoute) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(test::run("ip link set lo up"));
    const NetworkInterface lo = interface_named("lo");
    const Finding missing = probe_multicast_route(lo, kGroup);
    EXPECT_EQ(missing.level, FindingLevel::note);
    EXPECT_NE(missing.what.find("unreachable"), std::string::npos) << missing.what;
    // The remedy is a working command. Reckon's own link did not need it.
    EXPECT_EQ(probe_up_to_five_times(lo).level, FindingLevel::ok);
    ASSERT_TRUE(test::run(missing.remedy.c_str()));
    EXPECT_EQ(probe_multicast_route(lo, kGroup).level, FindingLevel::ok);
  });
}

TEST(HostLimits, ReadTheLimitsOfTheirNamespace) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(test::run("ip link set lo up"));
    ASSERT_TRUE(test::run("echo 0 > /proc/sys/net/ipv4/igmp_max_memberships"));
    EXPECT_EQ(probe_memberships().level, FindingLevel::problem);
    ASSERT_TRUE(test::run("echo 20 > /proc/sys/net/ipv4/igmp_max_memberships"));
    EXPECT_EQ(probe_memberships().level, FindingLevel::ok);
    ASSERT_TRUE(test::run("echo 1 > /proc/sys/net/ipv4/conf/lo/rp_filter"));
    EXPECT_EQ(probe_reverse_path_filter(interface_named("lo")).level, FindingLevel::note);
    ASSERT_TRUE(test::run("echo 0 > /proc/sys/net/ipv4/conf/lo/rp_filter"));
    ASSERT_TRUE(test::run("echo 0 > /proc/sys/net/ipv4/conf/all/rp_filter"));
    EXPECT_EQ(probe_reverse_path_filter(interface_named("lo")).level, FindingLevel::ok);
  });
}

TEST(HostLimits, JudgeTheMtu) {
  NetworkInterface interface;
  interface.name = "eth0";
  interface.mtu = 1500;
  EXPECT_EQ(probe_mtu(interface, 1288).level, FindingLevel::ok);
  const Finding of_long_bundles = probe_mtu(interface, 8888);
  EXPECT_EQ(of_long_bundles.level, FindingLevel::warning);
  EXPECT_THAT(of_long_bundles.remedy, testing::HasSubstr("mtu 9000"));
  interface.mtu = 9000;
  EXPECT_EQ(probe_mtu(interface, 8888).level, FindingLevel::ok);
  interface.mtu = 1400;
  EXPECT_EQ(probe_mtu(interface, 1288).level, FindingLevel::note);
  interface.mtu = 1280;
  EXPECT_EQ(probe_mtu(interface, 1288).level, FindingLevel::problem);
}

TEST(HostLimits, JudgeTheKindOfInterface) {
  NetworkInterface interface;
  EXPECT_EQ(probe_interface_kind(interface).level, FindingLevel::ok);
  interface.virtual_device = true;
  EXPECT_EQ(probe_interface_kind(interface).level, FindingLevel::note);
  interface.wireless = true;
  EXPECT_EQ(probe_interface_kind(interface).level, FindingLevel::warning);
}

TEST(HostLimits, MeasureTheTimer) {
  const Finding finding = probe_timer(20ms);
  EXPECT_NE(finding.what.find("p99"), std::string::npos) << finding.what;
  EXPECT_NE(finding.what.find("timer slack"), std::string::npos);
}

TEST(HostLimits, LeaveTheCallersSchedulingAlone) {
  const int before = sched_getscheduler(0);
  (void)probe_real_time();
  EXPECT_EQ(sched_getscheduler(0), before);
}

TEST(HostLimits, RefuseMoreGroupsThanFilesCanBeOpen) {
  EXPECT_EQ(probe_open_files(10).level, FindingLevel::ok);
  EXPECT_EQ(probe_open_files(std::size_t{1} << 40).level, FindingLevel::problem);
}

TEST(HostLimits, ReportWhetherTheKernelHandlesRuns) {
  const Finding finding = probe_offload(interface_named("lo"), kGroup);
  EXPECT_EQ(finding.level, FindingLevel::ok) << finding.what;
  EXPECT_NE(finding.what.find("segmented by the kernel (UDP_SEGMENT)"), std::string::npos);
  EXPECT_NE(finding.what.find("taken whole (UDP_GRO)"), std::string::npos);
}

TEST(HostLimits, GiveEveryProblemARemedy) {
  for (const Finding& finding : examine_host(interface_named("lo"), {})) {
    EXPECT_FALSE(finding.what.empty());
    if (finding.level >= FindingLevel::warning) {
      EXPECT_FALSE(finding.remedy.empty()) << finding.what;
    }
    std::cout << "  " << name(finding.level) << ": " << finding.what << "\n";
  }
}

}  // namespace
}  // namespace reckon::peer::host_limits_test
