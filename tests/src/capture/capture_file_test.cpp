// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/capture_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes u16(std::size_t value) {
  return {static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}

Bytes udp(std::size_t payload, std::size_t length_field) {
  return u16(3001) + u16(3000) + u16(length_field) + u16(0) + Bytes(payload, 0x5a);
}
Bytes udp(std::size_t payload) { return udp(payload, payload + 8); }

Bytes ipv4(const Bytes& payload, std::uint8_t protocol = 17, std::size_t fragment = 0) {
  return Bytes{0x45, 0} + u16(20 + payload.size()) + u16(1) + u16(fragment) +
         Bytes{1, protocol, 0, 0, 10, 0, 0, 1, 239, 1, 2, 3} + payload;
}

Bytes ipv6(const Bytes& payload, std::uint8_t next = 17) {
  Bytes out = Bytes{0x60, 0, 0, 0} + u16(payload.size()) + Bytes{next, 1} + Bytes(32, 0) + payload;
  out[8] = 0xfd;
  out[23] = 7;
  out[24] = 0xff;
  out[25] = 0x15;
  return out;
}

Bytes ethernet(const Bytes& payload, std::size_t type = 0x0800) {
  return Bytes(12, 1) + u16(type) + payload;
}

struct Parsed {
  FrameContent content;
  SourceDatagram datagram;
};

Parsed parse(LinkLayer layer, const Bytes& frame, std::size_t on_wire = 0) {
  Parsed out{};
  out.content = parse_frame(layer, std::as_bytes(std::span(frame)), on_wire, out.datagram);
  return out;
}

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

TEST(ParseFrame, FindsUdpBehindEveryLinkLayer) {
  const Bytes ip = ipv4(udp(100));
  const std::vector<std::pair<LinkLayer, Bytes>> frames = {
      {LinkLayer::ethernet, ethernet(ip)},
      {LinkLayer::ethernet, Bytes(12, 1) + u16(0x8100) + u16(7) + u16(0x0800) + ip},
      {LinkLayer::ethernet,
       Bytes(12, 1) + u16(0x88a8) + u16(7) + u16(0x8100) + u16(8) + u16(0x0800) + ip},
      {LinkLayer::raw_ip, ip},
      {LinkLayer::linux_cooked, Bytes(14, 0) + u16(0x0800) + ip},
      {LinkLayer::linux_cooked_2, u16(0x0800) + Bytes(18, 0) + ip},
      {LinkLayer::bsd_loopback, Bytes{2, 0, 0, 0} + ip}};
  for (const auto& [layer, frame] : frames) {
    const Parsed parsed = parse(layer, frame);
    ASSERT_EQ(parsed.content, FrameContent::udp);
    EXPECT_EQ(parsed.datagram.source.text(), "10.0.0.1:3001");
    EXPECT_EQ(parsed.datagram.group.text(), "239.1.2.3:3000");
    EXPECT_EQ(parsed.datagram.bytes.size(), 100u);
    EXPECT_EQ(parsed.datagram.portion, Portion::whole);
  }
}

TEST(ParseFrame, FindsUdpBehindIpv6ExtensionHeaders) {
  const Bytes hop = Bytes{60, 0, 0, 0, 0, 0, 0, 0};       // then destination options
  const Bytes destination = Bytes{17, 1} + Bytes(14, 0);  // 16 octets, then UDP
  const Parsed plain = parse(LinkLayer::ethernet, ethernet(ipv6(udp(50)), 0x86dd));
  ASSERT_EQ(plain.content, FrameContent::udp);
  EXPECT_EQ(plain.datagram.source.text(), "[fd00::7]:3001");
  EXPECT_EQ(plain.datagram.group.text(), "[ff15::]:3000");
  const Parsed extended = parse(LinkLayer::raw_ip, ipv6(hop + destination + udp(50), 0));
  ASSERT_EQ(extended.content, FrameContent::udp);
  EXPECT_EQ(extended.datagram.bytes.size(), 50u);
}

TEST(ParseFrame, TellsFragmentsAsSuch) {
  const Parsed first = parse(LinkLayer::raw_ip, ipv4(udp(64, 3000), 17, 0x2000));
  EXPECT_EQ(first.datagram.portion, Portion::first_fragment);
  EXPECT_EQ(first.datagram.bytes.size(), 64u);
  EXPECT_EQ(first.datagram.group.port, 3000);
  const Parsed later = parse(LinkLayer::raw_ip, ipv4(Bytes(64, 1), 17, 0x2009));
  EXPECT_EQ(later.content, FrameContent::udp);
  EXPECT_EQ(later.datagram.portion, Portion::later_fragment);
  EXPECT_EQ(later.datagram.group.port, 0);
  const Bytes first6 = Bytes{17, 0, 0, 1, 0, 0, 0, 9} + udp(40, 3000);
  const Bytes later6 = Bytes{17, 0, 0, 0x30, 0, 0, 0, 9} + Bytes(40, 1);
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv6(first6, 44)).datagram.portion, Portion::first_fragment);
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv6(later6, 44)).datagram.portion, Portion::later_fragment);
}

TEST(ParseFrame, IgnoresEthernetPadding) {
  const Parsed parsed = parse(LinkLayer::ethernet, ethernet(ipv4(udp(4))) + Bytes(14, 0xee));
  EXPECT_EQ(parsed.datagram.bytes.size(), 4u);
  EXPECT_EQ(parsed.datagram.portion, Portion::whole);
}

TEST(ParseFrame, TellsWhatTheCaptureCut) {
  Bytes frame = ethernet(ipv4(udp(100)));
  const std::size_t on_wire = frame.size();
  frame.resize(on_wire - 60);
  const Parsed parsed = parse(LinkLayer::ethernet, frame, on_wire);
  EXPECT_EQ(parsed.content, FrameContent::udp);
  EXPECT_EQ(parsed.datagram.portion, Portion::cut);
  EXPECT_EQ(parsed.datagram.bytes.size(), 40u);
}

TEST(ParseFrame, SkipsWhatIsNotUdp) {
  EXPECT_EQ(parse(LinkLayer::ethernet, ethernet(Bytes(28, 0), 0x0806)).content,
            FrameContent::not_udp);
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv4(Bytes(30, 0), 6)).content, FrameContent::not_udp);
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv6(Bytes(30, 0), 58)).content, FrameContent::not_udp);
}

TEST(ParseFrame, CallsLyingHeadersMalformed) {
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv4(udp(10, 7))).content, FrameContent::malformed);
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv4(udp(10, 19))).content, FrameContent::malformed);
  Bytes short_header = ipv4(udp(10));
  short_header[0] = 0x44;
  EXPECT_EQ(parse(LinkLayer::raw_ip, short_header).content, FrameContent::malformed);
  Bytes long_total = ipv4(udp(10));
  long_total[3] = 0xff;
  EXPECT_EQ(parse(LinkLayer::raw_ip, long_total).content, FrameContent::malformed);
}

TEST(ParseFrame, SurvivesEveryTruncationAndRandomOctets) {
  const std::vector<Bytes> seeds = {
      ethernet(ipv4(udp(30))),
      ethernet(ipv6(Bytes{60, 0, 0, 0, 0, 0, 0, 0} + Bytes{17, 1} + Bytes(14, 0) + udp(30), 0),
               0x86dd)};
  std::mt19937 random(3);
  for (const Bytes& seed : seeds) {
    for (std::size_t length = 0; length <= seed.size(); ++length) {
      const Bytes frame(seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(length));
      (void)parse(LinkLayer::ethernet, frame, length % 2 == 0 ? seed.size() : length);
    }
    for (int i = 0; i < 200'000; ++i) {
      Bytes frame = seed;
      for (int k = 0; k < 3; ++k) {
        frame[random() % frame.size()] = static_cast<std::uint8_t>(random());
      }
      frame.resize(frame.size() - random() % 4);
      const auto layer = static_cast<LinkLayer>(random() % 5);
      const Parsed parsed = parse(layer, frame);
      if (parsed.content != FrameContent::udp) continue;
      const auto* begin = reinterpret_cast<const std::byte*>(frame.data());
      ASSERT_LE(parsed.datagram.bytes.data() + parsed.datagram.bytes.size(), begin + frame.size());
    }
  }
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

TEST(CaptureFile, TellsATimeBeyondAllClocksAsTheYear2160) {
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

TEST(CaptureFile, GivesWhatComesBeforeTheCutAndSaysSo) {
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

TEST(CaptureFile, RefusesWhatIsNoCapture) {
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

TEST(LiveGroups, HandOutWhatIsSentToThem) {
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
}  // namespace reckon::peer
