// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/interface_choice.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace reckon::peer {
namespace {

NetworkInterface make(const char* name, unsigned index, const char* address) {
  NetworkInterface out;
  out.name = name;
  out.index = index;
  out.addresses = {*IpEndpoint::parse(address)};
  out.mtu = 1500;
  out.up = out.running = out.multicast = true;
  return out;
}

std::vector<NetworkInterface> laptop() {
  std::vector<NetworkInterface> all = {
      make("lo", 1, "127.0.0.1"), make("wlan0", 2, "192.168.1.5"), make("tun0", 3, "10.8.0.2"),
      make("docker0", 4, "172.17.0.1"), make("eth0", 5, "192.168.1.4")};
  all[0].loopback = true;
  all[0].multicast = false;
  all[0].virtual_device = true;
  all[1].wireless = true;
  all[2].point_to_point = all[2].virtual_device = true;
  all[2].multicast = false;
  all[3].virtual_device = true;
  return all;
}

TEST(InterfaceChoice, TakesTheCableOfALaptop) {
  const InterfaceChoice choice = choose_interface(laptop(), "", false);
  EXPECT_EQ(choice.interface.name, "eth0");
  EXPECT_NE(choice.explanation.find("eth0 (index 5, 192.168.1.4): score 15"), std::string::npos)
      << choice.explanation;
  EXPECT_NE(choice.explanation.find("--iface"), std::string::npos);
  EXPECT_EQ(choice.sentence, "interface eth0 (192.168.1.4), the best of 5; --iface names another");
}

TEST(InterfaceChoice, FindsAnInterfaceAgainByItsName) {
  std::vector<NetworkInterface> all = laptop();
  const NetworkInterface used = all[4];
  all[4].index = 17;
  all[4].addresses = {*IpEndpoint::parse("10.0.0.7")};
  EXPECT_EQ(find_again(all, "eth0", used, false).interface->index, 17u);
  EXPECT_EQ(find_again(all, "", used, false).interface->index, 17u);
  EXPECT_EQ(find_again(all, "5", used, false).interface->index, 17u);
  EXPECT_EQ(find_again(all, "eth0", used, true).why_not, "has no IPv6 address");
  all[4].running = false;
  EXPECT_EQ(find_again(all, "", used, false).why_not, "has no carrier");
  all[4].up = false;
  EXPECT_EQ(find_again(all, "", used, false).why_not, "is down");
  all.pop_back();
  EXPECT_EQ(find_again(all, "", used, false).why_not, "is gone");
}

TEST(InterfaceChoice, FindsTheRequestedAddressOnAnotherInterface) {
  std::vector<NetworkInterface> all = laptop();
  const NetworkInterface used = all[4];
  all[4].addresses = {*IpEndpoint::parse("10.0.0.7")};
  EXPECT_EQ(find_again(all, "192.168.1.4", used, false).why_not, "has lost its address");
  all[1].addresses.push_back(*IpEndpoint::parse("192.168.1.4"));
  EXPECT_EQ(find_again(all, "192.168.1.4", used, false).interface->name, "wlan0");
}

TEST(InterfaceChoice, PrefersWirelessToBridgesAndTunnels) {
  std::vector<NetworkInterface> all = laptop();
  all.pop_back();
  EXPECT_EQ(choose_interface(all, "", false).interface.name, "wlan0");
  all[1].up = false;
  EXPECT_EQ(choose_interface(all, "", false).interface.name, "docker0");
}

TEST(InterfaceChoice, UsesLinkLocalAddressesOnlyAsLastResort) {
  std::vector<NetworkInterface> all = {make("eth0", 2, "169.254.3.4"), make("eth1", 3, "10.0.0.1")};
  EXPECT_EQ(choose_interface(all, "", false).interface.name, "eth1");
  all.pop_back();
  EXPECT_EQ(choose_interface(all, "", false).interface.name, "eth0");
}

TEST(InterfaceChoice, FallsBackToLoopback) {
  std::vector<NetworkInterface> all = laptop();
  for (std::size_t i = 1; i < all.size(); ++i) all[i].running = false;
  const InterfaceChoice choice = choose_interface(all, "", false);
  EXPECT_EQ(choice.interface.name, "lo");
  EXPECT_EQ(choice.sentence.find("WARNING: no other host is reached: interface lo, because no "
                                 "other can be used (wlan0: it has no carrier, tun0: "),
            0U)
      << choice.sentence;
  EXPECT_EQ(choose_interface(all, "lo", false).sentence, "interface lo, as asked for");
}

TEST(InterfaceChoice, TakesTheLowerIndexAmongEquals) {
  const std::vector<NetworkInterface> all = {make("b", 9, "10.0.0.2"), make("a", 4, "10.0.0.1")};
  EXPECT_EQ(choose_interface(all, "", false).interface.name, "a");
}

TEST(InterfaceChoice, ObeysNameAddressAndIndex) {
  EXPECT_EQ(choose_interface(laptop(), "tun0", false).interface.name, "tun0");
  EXPECT_EQ(choose_interface(laptop(), "172.17.0.1", false).interface.name, "docker0");
  EXPECT_EQ(choose_interface(laptop(), "2", false).interface.name, "wlan0");
}

TEST(InterfaceChoice, ListsTheInterfacesWhenTheNameIsWrong) {
  try {
    (void)choose_interface(laptop(), "eth9", false);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'eth9'"), std::string::npos);
    EXPECT_NE(text.find("wlan0"), std::string::npos);
    EXPECT_NE(text.find("eth0"), std::string::npos);
  }
}

TEST(InterfaceChoice, RefusesARequestedInterfaceThatIsDown) {
  std::vector<NetworkInterface> all = laptop();
  all[4].up = false;
  EXPECT_THROW((void)choose_interface(all, "eth0", false), std::runtime_error);
  EXPECT_THROW((void)choose_interface(all, "", true), std::runtime_error);  // no IPv6 anywhere
}

TEST(InterfaceChoice, TakesARequestedInterfaceWithoutCarrier) {
  std::vector<NetworkInterface> all = laptop();
  all[4].running = false;
  EXPECT_NE(choose_interface(all, "eth0", false).explanation.find("no carrier"), std::string::npos);
  EXPECT_EQ(choose_interface(all, "", false).interface.name, "wlan0");
}

TEST(InterfaceChoice, PrefersIpv6AddressesThatAreNotLinkLocal) {
  NetworkInterface interface = make("eth0", 2, "fe80::1");
  interface.addresses.push_back(*IpEndpoint::parse("fd00::2"));
  EXPECT_EQ(interface.address(true)->address_text(), "fd00::2");
  EXPECT_FALSE(interface.address(false));
}

TEST(Broadcast, MayHaveAHostPartOfAllOnes) {
  for (const char* text :
       {"255.255.255.255", "10.9.9.255", "10.9.11.255", "10.9.9.127", "10.9.9.3"})
    EXPECT_TRUE(may_be_broadcast(*IpEndpoint::parse(text))) << text;
  for (const char* text : {"10.9.9.1", "10.9.9.254", "239.1.2.3", "0.0.0.255", "ff15::ff"})
    EXPECT_FALSE(may_be_broadcast(*IpEndpoint::parse(text))) << text;
}

TEST(ListInterfaces, FindsLoopback) {
  bool found = false;
  for (const NetworkInterface& interface : list_interfaces()) {
    if (interface.name != "lo") continue;
    found = true;
    EXPECT_TRUE(interface.loopback);
    EXPECT_GT(interface.index, 0u);
    EXPECT_GT(interface.mtu, 1500u);
    EXPECT_TRUE(interface.address(false));
    ASSERT_FALSE(interface.broadcasts.empty());
    EXPECT_EQ(interface.broadcasts.front().text(), "127.255.255.255:0");
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace reckon::peer
