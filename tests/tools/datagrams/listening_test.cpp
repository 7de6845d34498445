// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reports to the user about a live source.
#include "reckon/tools/datagrams/listening.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <string>
#include <thread>

#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/sealing/envelope.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::AnyOf;  // other tests of this host may send in the default groups
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

peer::IpEndpoint endpoint(const char* text) { return *peer::IpEndpoint::parse(text); }

TEST(Listening, ReportsAddressesAndCountsOfEachInterface) {
  SourceChoice choice;
  choice.source = "udp://239.1.2.3";
  peer::SourceReport report;
  report.interfaces = {{"lo", 3}, {"eth0", 1}, {"eth1", 0}};
  EXPECT_EQ(listening_text(choice, report), "239.1.2.3:3000 on lo, eth0 and eth1");
  EXPECT_EQ(heard_text(report), "received on lo: 3 datagrams, eth0: 1 datagram, eth1: none\n");
  report.copies = 2;
  report.unheard = {"not all groups are received on eth1: No buffer space available"};
  EXPECT_THAT(heard_text(report),
              HasSubstr("; 2 datagrams also arrived on another interface\nnot"));
  choice.source = "iface:lo";
  EXPECT_EQ(listening_text(choice, {}), "all UDP of lo");
  EXPECT_EQ(heard_text({}), "");
}

TEST(OtherPlaces, AreBroadcastDefaultAndBoundAddresses) {
  const std::vector own{endpoint("239.7.7.7:7000"), endpoint("239.7.7.8:7000")};
  const std::vector bound{endpoint("239.7.7.8:7000"),   endpoint("239.9.9.9:6400"),
                          endpoint("0.0.0.0:68"),       endpoint("239.9.9.9:6400"),
                          endpoint("239.192.1.1:3000"), endpoint("239.192.1.1:3001")};
  const std::vector rest{endpoint("239.7.7.7:7001"),       endpoint("239.192.1.0:3000"),
                         endpoint("239.192.1.0:3001"),     endpoint("255.255.255.255:7000"),
                         endpoint("255.255.255.255:3000"), endpoint("239.9.9.9:6400")};
  EXPECT_EQ(other_places(own, false, bound, 32), rest);
  EXPECT_EQ(other_places(own, true, bound, 32).front(), own.front());
  EXPECT_EQ(other_places(own, false, bound, 2).size(), 2U);
}

TEST(SilenceWatch, ReportsAfterThreeSecondsWithTrafficElsewhere) {
  const std::string port = std::to_string(20000 + getpid() % 20000);
  SourceChoice choice;
  choice.source = "udp://239.192.77.2:" + port;
  choice.interface = "lo";
  peer::SourceReport report;
  report.interfaces = {{"lo", 0}};
  SilenceWatch silence(choice, 100s);
  EXPECT_THAT(silence.look(report, 102s), IsEmpty());
  const peer::SteadyClock clock;
  peer::UdpMulticastOptions options;
  options.interface = "lo";
  peer::UdpMulticast sender(options, clock);
  const peer::GroupAddress elsewhere = endpoint(("239.192.77.3:" + port).c_str());
  ASSERT_FALSE(sender.join(elsewhere)) << "a program of this host listens there";
  EXPECT_THAT(silence.look(report, 103s),
              ElementsAre("nothing received yet at 239.192.77.2:" + port + " on lo"));
  std::array<std::byte, 12> pdu{std::byte{7}, std::byte{1}, std::byte{11}, std::byte{5}};
  pdu[9] = std::byte{12};
  std::vector<std::string> told;
  for (int i = 0; i < 200 && told.empty(); ++i) {
    ASSERT_TRUE(sender.send(elsewhere, pdu));
    std::this_thread::sleep_for(5ms);
    told = silence.look(report, 104s);
  }
  EXPECT_THAT(told,
              Contains(AllOf(HasSubstr("received by this host: " + elsewhere.text() + " on lo"),
                             HasSubstr("write udp://" + elsewhere.text()))));
  EXPECT_THAT(silence.look(report, 120s), IsEmpty());
}

TEST(SilenceWatch, AsksForTheKeyOfSealedDatagrams) {
  const auto port = static_cast<std::uint16_t>(20000 + getpid() % 20000);
  SourceChoice choice;
  choice.source = fmt::format("udp://239.192.77.6:{}", port);
  choice.interface = "lo";
  SilenceWatch silence(choice, 0s);
  (void)silence.look({}, 3s);
  const peer::SteadyClock clock;
  peer::UdpMulticastOptions options;
  options.interface = "lo";
  peer::UdpMulticast sender(options, clock);
  const peer::GroupAddress sealed = endpoint(fmt::format("239.192.77.6:{}", port + 1).c_str());
  ASSERT_FALSE(sender.join(sealed)) << "a program of this host listens there";
  std::array<std::byte, peer::kEnvelope> envelope{std::byte{peer::kSealedOctet}};
  std::vector<std::string> told;
  for (int i = 0; i < 200 && told.empty(); ++i) {
    ASSERT_TRUE(sender.send(sealed, envelope));
    std::this_thread::sleep_for(5ms);
    told = silence.look({}, 4s);
  }
  EXPECT_THAT(told, Contains(HasSubstr(fmt::format(
                        "sealed datagrams arrive on port {}; give --key FILE", port + 1))));
}

TEST(SilenceWatch, ReportsOnceThatNothingIsReceivedElsewhere) {
  SourceChoice choice;
  choice.source = "udp://239.192.77.4:" + std::to_string(20001 + getpid() % 20000);
  SilenceWatch silence(choice, 0s);
  EXPECT_THAT(silence.look({}, 3s), Contains(HasSubstr("nothing received yet")));
  EXPECT_THAT(silence.look({}, 20s),
              Contains(AnyOf(HasSubstr("no DIS at"), HasSubstr("received by this host"))));
  EXPECT_THAT(silence.look({}, 21s), IsEmpty());
}

TEST(SilenceWatch, IsSilentForAReceivedSource) {
  SourceChoice choice;
  choice.source = "udp://239.192.77.5";
  SilenceWatch silence(choice, 0s);
  peer::SourceReport report;
  report.datagrams = 1;
  EXPECT_THAT(silence.look(report, 2s), IsEmpty());
  report.datagrams = 0;
  EXPECT_THAT(silence.look(report, 9s), IsEmpty());
}

}  // namespace
}  // namespace reckon::tools
