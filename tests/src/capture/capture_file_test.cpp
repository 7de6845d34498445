// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/tests/src/support/made_frames.hpp"
#include "reckon/tests/src/support/own_network.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::peer::capture_file_test {
namespace {

using namespace frames;
using namespace std::chrono_literals;
// A little-endian pcap file with microsecond stamps.
std::string write_pcap(const std::string& name, std::uint32_t link_type,
                       const std::vector<Bytes>& frames) {
  const std::string path = testing::TempDir() + "/" + std::to_string(getpid()) + name;
  std::ofstream file(path, std::ios::binary);
  const auto u32 = [&file](std::uint32_t value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::uint32_t word : {0xa1b2c3d4u, 0x00040002u, 0u, 0u, 65535u, link_type}) u32(word);
  std::uint32_t second = 1000;
  for (const Bytes& frame : frames) {
    u32(second++);
    u32(250000);
    u32(static_cast<std::uint32_t>(frame.size()));
    u32(static_cast<std::uint32_t>(frame.size()));
    file.write(reinterpret_cast<const char*>(frame.data()),
               static_cast<std::streamsize>(frame.size()));
  }
  return path;
}

SourceReport read_all(DatagramSource& source, std::uint64_t* octets = nullptr) {
  SourceDatagram datagram;
  while (source.next(datagram, 0ns) == SourceEvent::datagram) {
    if (octets != nullptr) *octets += datagram.bytes.size();
  }
  return source.report();
}

TEST(CaptureFile, ReadsTimesFramesAndCounts) {
  const std::string path = write_pcap("mixed.pcap", 1,
                                      {ethernet(ipv4(udp(10))), ethernet(Bytes(28, 0), 0x0806),
                                       ethernet(ipv4(udp(5, 7))), ethernet(ipv4(udp(20)))});
  const auto source = open_source(path);
  EXPECT_FALSE(source->is_live());
  SourceDatagram datagram;
  ASSERT_EQ(source->next(datagram, 0ns), SourceEvent::datagram);
  EXPECT_EQ(datagram.frame, 1u);
  EXPECT_EQ(datagram.time, 1000s + 250ms);
  ASSERT_EQ(source->next(datagram, 0ns), SourceEvent::datagram);
  EXPECT_EQ(datagram.frame, 4u);
  EXPECT_EQ(datagram.bytes.size(), 20u);
  EXPECT_EQ(source->next(datagram, 0ns), SourceEvent::end);
  EXPECT_EQ(source->next(datagram, 0ns), SourceEvent::end);
  EXPECT_EQ(source->report().frames, 4u);
  EXPECT_EQ(source->report().datagrams, 2u);
  EXPECT_EQ(source->report().skipped, 1u);
  EXPECT_EQ(source->report().malformed, 1u);
  EXPECT_TRUE(source->report().problem.empty());
  std::filesystem::remove(path);
}

TEST(CaptureFile, CountsTunnelsThatAreNotReadByName) {
  const Bytes unread = mpls(Bytes(40, 0xff));
  const std::string path =
      write_pcap("tunnels.pcap", 1,
                 {unread, ethernet(vxlan(ethernet(ipv4(udp(10))))), unread,
                  ethernet(gre(Bytes(40, 0), 0x880b, 0x2001)), ethernet(Bytes(28, 0), 0x0806)});
  const auto source = open_source(path);
  const SourceReport report = read_all(*source);
  EXPECT_EQ(report.datagrams, 1u);
  EXPECT_EQ(report.skipped, 4u);
  EXPECT_EQ(report.problem,
            path + ": 1 frame of GRE of PPTP is not read; 2 frames of MPLS are not read");
  std::filesystem::remove(path);
}

TEST(CaptureFile, ReadsTunnelsAsTsharkDoes) {
  RECKON_NEED_DATA("field");
  const auto path = test::reference_data() / "field/g06-tunnels-vxlan-erspan-ipip.pcap";
  std::uint64_t octets = 0;
  const SourceReport report = read_all(*open_source(path.string()), &octets);
  EXPECT_EQ(report.datagrams, 3u);
  EXPECT_EQ(octets, 3u * 144u);
  EXPECT_EQ(report.problem, "");
}

// A little-endian pcapng file of one frame; `stamp` counts units of 10^-resolution seconds.
std::string write_pcapng(std::uint32_t resolution, std::uint64_t stamp) {
  const Bytes frame = ethernet(ipv4(udp(142)));  // a multiple of 4 octets
  const auto size = static_cast<std::uint32_t>(frame.size());
  std::vector<std::uint32_t> words{0x0a0d0d0a, 28, 0x1a2b3c4d, 1, ~0U, ~0U, 28};
  for (const std::uint32_t word : {1U, 32U, 1U, 65535U, 0x00010009U, resolution, 0U, 32U})
    words.push_back(word);
  for (const std::uint32_t word : {6U, 32 + size, 0U, static_cast<std::uint32_t>(stamp >> 32),
                                   static_cast<std::uint32_t>(stamp), size, size})
    words.push_back(word);
  words.resize(words.size() + size / 4);
  std::memcpy(words.data() + words.size() - size / 4, frame.data(), size);
  words.push_back(32 + size);

  const std::string path = testing::TempDir() + "/" + std::to_string(getpid()) + "stamp.pcapng";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(words.data()),
             static_cast<std::streamsize>(4 * words.size()));
  return path;
}

TEST(CaptureFile, TimeBeyondAllClocksReadsAsYear2160) {
  constexpr std::chrono::seconds kLatest(6'000'000'000);
  struct Case {
    std::uint32_t resolution;
    std::uint64_t stamp;
    std::chrono::nanoseconds time;
  };
  for (const Case& row : {Case{9, 1'600'000'000'000'000'001, 1'600'000'000'000'000'001ns},
                          Case{0, 0x7fffffff'ffffffff, kLatest}, Case{0, 6'000'000'001, kLatest},
                          Case{0, 5'999'999'999, kLatest - 1s}}) {
    const std::string path = write_pcapng(row.resolution, row.stamp);
    SourceDatagram datagram;
    ASSERT_EQ(open_capture(path)->next(datagram, 0ns), SourceEvent::datagram);
    EXPECT_EQ(datagram.time, row.time) << row.stamp;
    std::filesystem::remove(path);
  }
}

TEST(CaptureFile, ReadsUpToTheCutAndReportsIt) {
  const std::string path =
      write_pcap("cut.pcap", 1, {ethernet(ipv4(udp(10))), ethernet(ipv4(udp(300)))});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 100);
  const auto source = open_source(path);
  const SourceReport report = read_all(*source);
  EXPECT_EQ(report.datagrams, 1u);
  EXPECT_NE(report.problem.find("beyond frame 1"), std::string::npos) << report.problem;
  EXPECT_NE(report.problem.find("truncated"), std::string::npos) << report.problem;
  std::filesystem::remove(path);
}

TEST(CaptureFile, RefusesOtherFiles) {
  const std::string path = testing::TempDir() + "/" + std::to_string(getpid()) + "none";
  std::ofstream(path) << "this is no capture at all, only some text";
  try {
    (void)open_source(path);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("raw:"), std::string::npos);
  }
  EXPECT_THROW((void)open_source("/nowhere/none.pcap"), std::runtime_error);
  EXPECT_THROW((void)open_source("iface:none0"), std::runtime_error);
  const std::string usb = write_pcap("usb.pcap", 220, {});
  EXPECT_THROW((void)open_source(usb), std::runtime_error);
  std::filesystem::remove(path);
  std::filesystem::remove(usb);
}

TEST(RawFile, IsOneDatagram) {
  const std::string path = testing::TempDir() + "/" + std::to_string(getpid()) + "raw";
  std::ofstream(path, std::ios::binary) << std::string(144, 'x');
  const auto source = open_source("raw:" + path);
  SourceDatagram datagram;
  ASSERT_EQ(source->next(datagram, 0ns), SourceEvent::datagram);
  EXPECT_EQ(datagram.frame, 1u);
  EXPECT_EQ(datagram.bytes.size(), 144u);
  EXPECT_TRUE(datagram.group.is_unspecified());
  EXPECT_EQ(source->next(datagram, 0ns), SourceEvent::end);
  std::ofstream(path, std::ios::binary) << std::string(70000, 'x');
  const auto longer = open_source("raw:" + path);
  ASSERT_EQ(longer->next(datagram, 0ns), SourceEvent::datagram);
  EXPECT_EQ(datagram.portion, Portion::cut);
  EXPECT_FALSE(longer->report().problem.empty());
  std::filesystem::remove(path);
  EXPECT_THROW((void)open_source("raw:" + path), std::system_error);
  EXPECT_THROW((void)open_source("raw:/"), std::system_error);
}

TEST(CaptureFile, CountsTheDatagramsOfTheReferenceCaptures) {
  RECKON_NEED_DATA("dis-captures");
  const std::map<std::string, std::uint64_t> expected = {
      {"real-sessions/turn90-1", 197},
      {"real-sessions/turn90-2", 171},
      {"real-sessions/gaz69-straight", 174},
      {"real-sessions/gaz69-patrol", 231},
      {"real-sessions/gaz69-single-block", 320},
      {"real-sessions/gaz69-multi-block-1", 1280},
      {"real-sessions/gaz69-multi-block-2", 1222},
      {"generated-a/a-entity-state", 27},
      {"generated-a/a-interaction", 18},
      {"generated-a/a-simulation-management", 19},
      {"generated-a/a-radio", 12},
      {"generated-a/a-bundles", 9},
      {"generated-a/a-custom", 7},
      {"generated-a/a-malformed", 38}};
  for (const auto& [name, datagrams] : expected) {
    const auto path = test::reference_data() / "dis-captures" / (name + ".pcap");
    const SourceReport report = read_all(*open_source(path.string()));
    EXPECT_EQ(report.datagrams, datagrams) << name;
    EXPECT_EQ(report.skipped + report.malformed + report.cut, 0u) << name;
    EXPECT_TRUE(report.problem.empty()) << report.problem;
  }
}

TEST(CaptureFile, ReadsPcapngAsPcap) {
  RECKON_NEED_DATA("dis-captures");
  if (std::system("command -v editcap >/dev/null") != 0) GTEST_SKIP() << "needs editcap";
  const auto path = test::reference_data() / "dis-captures/real-sessions/turn90-1.pcap";
  const std::string copy = testing::TempDir() + "/" + std::to_string(getpid()) + ".pcapng";
  ASSERT_EQ(std::system(("editcap -F pcapng " + path.string() + " " + copy).c_str()), 0);
  std::uint64_t first = 0, second = 0;
  EXPECT_EQ(read_all(*open_source(path.string()), &first).datagrams, 197u);
  EXPECT_EQ(read_all(*open_source(copy), &second).datagrams, 197u);
  EXPECT_EQ(first, second);
  std::filesystem::remove(copy);
}

TEST(LiveGroups, ReturnDatagramsSentToThem) {
  const SteadyClock clock;
  UdpMulticastOptions options;
  options.interface = "lo";
  UdpMulticast sender(options, clock);
  const auto port = static_cast<std::uint16_t>(20000 + getpid() % 20000);
  const GroupAddress group = IpEndpoint::v4(0xefc04d01, port);
  const auto source = open_groups({"lo", {group, IpEndpoint::v4(0xefc04d02, port)}});
  EXPECT_TRUE(source->is_live());
  SourceDatagram datagram;
  EXPECT_EQ(source->next(datagram, 0ns), SourceEvent::nothing_yet);
  ASSERT_TRUE(sender.send(group, std::vector<std::byte>(33)));
  ASSERT_EQ(source->next(datagram, 1s), SourceEvent::datagram);
  EXPECT_EQ(datagram.group, group);
  EXPECT_EQ(datagram.source, sender.local_endpoint());
  EXPECT_EQ(datagram.bytes.size(), 33u);
  EXPECT_LT(clock.utc_now() - datagram.time, 5s);
  source->stop();
  EXPECT_EQ(source->next(datagram, 20s), SourceEvent::end);
}

TEST(LiveGroups, CountDatagramsOfEachInterface) {
  RECKON_IN_OWN_NETWORK([] {
    test::make_cable();
    const SteadyClock clock;
    const GroupAddress group = IpEndpoint::v4(0xefc04d01, 31098);
    const auto source = open_groups({"", {group}});
    UdpMulticastOptions options;
    SourceDatagram datagram;
    const std::map<std::string, std::uint64_t> expected{{"a0", 2}, {"lo", 1}};
    for (const auto& [name, count] : expected) {
      options.interface = name;
      UdpMulticast sender(options, clock);
      for (std::uint64_t i = 0; i < count; ++i) {
        ASSERT_TRUE(sender.send(group, std::vector<std::byte>(33 + i)));
        ASSERT_EQ(source->next(datagram, 1s), SourceEvent::datagram) << name;
        EXPECT_EQ(datagram.interface, name);
      }
    }
    std::map<std::string, std::uint64_t> counted;
    for (const ListenedInterface& one : source->report().interfaces)
      if (one.datagrams > 0) counted[one.name] = one.datagrams;
    EXPECT_EQ(counted, expected);
  });
}

TEST(LiveInterface, CapturesUdpOfTheInterface) {
  std::unique_ptr<DatagramSource> source;
  try {
    source = open_source("iface:lo");
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "needs CAP_NET_RAW: " << error.what();
  }
  const SteadyClock clock;
  UdpMulticastOptions options;
  options.interface = "lo";
  UdpMulticast sender(options, clock);
  const GroupAddress group = IpEndpoint::v4(0xefc04d07, 31099);
  ASSERT_TRUE(sender.send(group, std::vector<std::byte>(77)));
  SourceDatagram datagram;
  SourceEvent event = source->next(datagram, 1s);
  for (int i = 0; i < 1000 && event == SourceEvent::datagram && datagram.group != group; ++i) {
    event = source->next(datagram, 1s);  // other programs use lo too
  }
  ASSERT_EQ(event, SourceEvent::datagram);
  EXPECT_EQ(datagram.bytes.size(), 77u);
  EXPECT_EQ(datagram.source, sender.local_endpoint());
}

}  // namespace
}  // namespace reckon::peer::capture_file_test
