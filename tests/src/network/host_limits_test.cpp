// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/host_limits.hpp"

#include <gtest/gtest.h>

#include "reckon/tests/src/support/own_network.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

NetworkInterface interface_named(std::string_view name) {
  for (const NetworkInterface& interface : list_interfaces()) {
    if (interface.name == name) return interface;
  }
  return {};
}

// The limit of 100 ms may be missed on a machine that is very busy.
Finding probe_up_to_five_times(const NetworkInterface& interface) {
  Finding finding = probe_multicast(interface, false);
  for (int i = 0; i < 4 && finding.level != FindingLevel::ok; ++i) {
    finding = probe_multicast(interface, false);
  }
  return finding;
}

TEST(HostLimits, HearOwnMulticastOnLoopback) {
  const Finding finding = probe_up_to_five_times(interface_named("lo"));
  EXPECT_EQ(finding.level, FindingLevel::ok) << finding.what;
  EXPECT_NE(finding.what.find("own datagram back after"), std::string::npos);
}

TEST(HostLimits, CallAnInterfaceWithoutAddressAProblem) {
  NetworkInterface none;
  none.name = "none0";
  const Finding finding = probe_multicast(none, false);
  EXPECT_EQ(finding.level, FindingLevel::problem);
  EXPECT_NE(finding.remedy.find("--iface"), std::string::npos);
}

TEST(HostLimits, TellAMissingMulticastRoute) {
  RECKON_IN_OWN_NETWORK([] {
    ASSERT_TRUE(test::run("ip link set lo up"));
    const NetworkInterface lo = interface_named("lo");
    const Finding missing = probe_multicast_route(lo, false);
    EXPECT_EQ(missing.level, FindingLevel::note);
    EXPECT_NE(missing.what.find("unreachable"), std::string::npos) << missing.what;
    // The remedy is a command that works, and Reckon's own link did not need it.
    EXPECT_EQ(probe_up_to_five_times(lo).level, FindingLevel::ok);
    ASSERT_TRUE(test::run(missing.remedy.c_str()));
    EXPECT_EQ(probe_multicast_route(lo, false).level, FindingLevel::ok);
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
  EXPECT_EQ(probe_mtu(interface).level, FindingLevel::ok);
  interface.mtu = 1400;
  EXPECT_EQ(probe_mtu(interface).level, FindingLevel::note);
  interface.mtu = 1280;
  EXPECT_EQ(probe_mtu(interface).level, FindingLevel::problem);
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
}  // namespace reckon::peer
