// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the UDP datagram in a captured frame, also behind false headers.
#include "reckon/peer/capture/frame_parser.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/tests/src/support/made_frames.hpp"

namespace reckon::peer {
namespace {

using namespace frames;

struct Parsed {
  FrameContent content;
  SourceDatagram datagram;
  std::optional<IpFragment> fragment;
  std::string_view unread;
};

Parsed parse(LinkLayer layer, const Bytes& frame, std::size_t on_wire = 0) {
  Parsed out{};
  const ParsedFrame parsed =
      parse_frame(layer, std::as_bytes(std::span(frame)), on_wire, out.datagram);
  out.content = parsed.content;
  out.fragment = parsed.fragment;
  out.unread = parsed.unread;
  return out;
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
      {LinkLayer::linux_cooked, Bytes(14, 0) + u16(0x8100) + u16(7) + u16(0x0800) + ip},
      {LinkLayer::linux_cooked_2, u16(0x0800) + Bytes(18, 0) + ip},
      {LinkLayer::linux_cooked_2, u16(0x8100) + Bytes(18, 0) + u16(7) + u16(0x0800) + ip},
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

TEST(ParseFrame, MarksFragments) {
  const Parsed first = parse(LinkLayer::raw_ip, ipv4(udp(64, 3000), 17, 0x2000));
  EXPECT_EQ(first.datagram.portion, Portion::first_fragment);
  EXPECT_EQ(first.datagram.bytes.size(), 64u);
  EXPECT_EQ(first.datagram.group.port, 3000);
  const Parsed later = parse(LinkLayer::raw_ip, ipv4(Bytes(64, 1), 17, 0x2009));
  EXPECT_EQ(later.content, FrameContent::udp);
  EXPECT_EQ(later.datagram.portion, Portion::later_fragment);
  EXPECT_EQ(later.datagram.group.port, 0);
  ASSERT_TRUE(later.fragment.has_value());
  EXPECT_EQ(later.fragment->offset, 72u);
  EXPECT_EQ(later.fragment->size, 64u);
  EXPECT_EQ(later.fragment->octets_at, 20u);
  EXPECT_TRUE(later.fragment->has_more);
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

TEST(ParseFrame, MarksADatagramCutByTheCapture) {
  Bytes frame = ethernet(ipv4(udp(100)));
  const std::size_t on_wire = frame.size();
  frame.resize(on_wire - 60);
  const Parsed parsed = parse(LinkLayer::ethernet, frame, on_wire);
  EXPECT_EQ(parsed.content, FrameContent::udp);
  EXPECT_EQ(parsed.datagram.portion, Portion::cut);
  EXPECT_EQ(parsed.datagram.bytes.size(), 40u);
}

TEST(ParseFrame, SkipsOtherProtocols) {
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

TEST(ParseFrame, FindsUdpInsideTunnelsAndMirrors) {
  // The inner addresses differ from the addresses of the tunnel.
  const Bytes packet = ipv6(udp(60));
  const Bytes frame = ethernet(packet, 0x86dd);
  const Bytes tagged = Bytes(12, 1) + u16(0x8100) + u16(7) + u16(0x86dd) + packet;
  const std::vector<std::pair<std::string_view, Bytes>> tunnels = {
      {"VXLAN", ethernet(vxlan(frame))},
      {"ERSPAN I", ethernet(gre(tagged, 0x88be))},
      {"ERSPAN II", ethernet(erspan(frame, 2))},
      {"ERSPAN III", ethernet(erspan(tagged, 3))},
      {"GRE of Ethernet", ethernet(gre(frame, 0x6558))},
      {"GRE of IP with checksum and key", ethernet(gre(Bytes(8, 0) + packet, 0x86dd, 0xa000))},
      {"IPv6 in IPv4", ethernet(ipv4(packet, 41))},
      {"IPv6 in IPv6", ethernet(ipv6(packet, 41), 0x86dd)},
      {"PPPoE", pppoe(packet, 0x0057)},
      {"MPLS of IP", mpls(packet)},
      {"MPLS of Ethernet", mpls(Bytes{0, 0, 0, 0} + frame)},
      {"VXLAN in IP in MPLS in PPPoE", pppoe(Bytes{0, 1, 17, 64} + ipv4(vxlan(frame), 4), 0x0281)}};
  for (const auto& [name, octets] : tunnels) {
    const Parsed parsed = parse(LinkLayer::ethernet, octets);
    ASSERT_EQ(parsed.content, FrameContent::udp) << name;
    EXPECT_EQ(parsed.datagram.source.text(), "[fd00::7]:3001") << name;
    EXPECT_EQ(parsed.datagram.bytes.size(), 60u) << name;
    EXPECT_EQ(parsed.datagram.portion, Portion::whole) << name;
  }
}

TEST(ParseFrame, ReadsFourNestedTunnelsAndNamesMore) {
  Bytes nested = ipv4(udp(9));
  for (int depth = 1; depth <= 6; ++depth) {
    nested = ipv4(nested, 4);
    const Parsed parsed = parse(LinkLayer::raw_ip, nested);
    EXPECT_EQ(parsed.content == FrameContent::udp, depth <= 4) << depth;
    EXPECT_EQ(parsed.unread, depth <= 4 ? "" : "more than 4 nested tunnels") << depth;
  }
}

TEST(ParseFrame, NamesTunnelsThatItCannotRead) {
  const Bytes ip = ipv4(udp(9));
  EXPECT_EQ(parse(LinkLayer::ethernet, mpls(Bytes(30, 0xff))).unread, "MPLS");
  EXPECT_EQ(parse(LinkLayer::raw_ip, gre(ip, 0x880b, 0x2001)).unread, "GRE of PPTP");
  EXPECT_EQ(parse(LinkLayer::ethernet, pppoe(ip, 0x00fd)).unread, "compressed or encrypted PPPoE");
  EXPECT_EQ(parse(LinkLayer::raw_ip, gre(Bytes(40, 0xff), 0x88be, 0x1000)).unread, "ERSPAN");
  // Link control carries no datagrams, and a datagram to the VXLAN port may be something else.
  EXPECT_EQ(parse(LinkLayer::ethernet, pppoe(ip, 0xc021)).unread, "");
  EXPECT_EQ(parse(LinkLayer::raw_ip, gre({}, 0)).content, FrameContent::not_udp);
  const Bytes other = u16(1) + u16(4789) + u16(20) + u16(0) + Bytes(12, 7);
  EXPECT_EQ(parse(LinkLayer::raw_ip, ipv4(other)).datagram.bytes.size(), 12u);
}

TEST(ParseFrame, CallsLyingTunnelsMalformed) {
  Bytes session = pppoe(ipv4(udp(9)));
  session[18] = 9;  // longer than the frame
  EXPECT_EQ(parse(LinkLayer::ethernet, session).content, FrameContent::malformed);
  EXPECT_EQ(parse(LinkLayer::raw_ip, gre(Bytes(3, 0), 0x0800, 0x2000)).content,
            FrameContent::malformed);
  EXPECT_EQ(parse(LinkLayer::raw_ip, vxlan(Bytes(13, 0))).content, FrameContent::malformed);
}

TEST(ParseFrame, SurvivesEveryTruncationAndRandomOctets) {
  const std::vector<Bytes> seeds = {
      ethernet(vxlan(ethernet(erspan(pppoe(ipv4(udp(30), 4)), 3)))),
      mpls(Bytes{0, 0, 0, 0} + ethernet(ipv4(ipv6(udp(30)), 41))), ethernet(ipv4(udp(30))),
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

}  // namespace
}  // namespace reckon::peer
