// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/frame_parser.hpp"

#include <algorithm>
#include <cstring>

#include "reckon/peer/capture/tunnels.hpp"

namespace reckon::peer {
namespace {

constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kUdpHeader = 8;
constexpr int kMostExtensionHeaders = 16;  // of IPv6
constexpr int kMostTunnels = 4;            // nested

/// The payload as described by the IP headers.
struct IpPayload {
  FrameOctets octets;
  std::uint8_t protocol = 0;  // of a later fragment: perhaps an extension header
  std::optional<IpFragment> fragment;

  [[nodiscard]] bool is_later_fragment() const { return fragment && fragment->offset > 0; }
};

bool is_read(std::uint8_t protocol) { return protocol == kProtocolUdp || is_tunnel(protocol); }

Carried behind_link_layer(LinkLayer layer, const FrameOctets& frame) {
  switch (layer) {
    case LinkLayer::ethernet:
      return behind_ethernet(frame);
    case LinkLayer::linux_cooked:
      return behind_ether_type(frame, 14, 16);
    case LinkLayer::linux_cooked_2:
      return behind_ether_type(frame, 0, 20);
    // The family number differs between systems and byte orders; the IP version identifies the
    // family too.
    case LinkLayer::bsd_loopback:
      if (!frame.has(4)) return {Carried::Kind::malformed, {}, {}};
      return {Carried::Kind::ip, frame.from(4), {}};
    case LinkLayer::raw_ip:
      return {Carried::Kind::ip, frame, {}};
  }
  return {};
}

void read_address(const FrameOctets& ip, std::size_t at, bool ipv6, IpEndpoint& out) {
  out = {};
  out.is_v6 = ipv6;
  std::memcpy(out.octets.data(), ip.at_hand.data() + at, ipv6 ? 16 : 4);
}

FrameContent read_ipv4(const FrameOctets& ip, SourceDatagram& out, IpPayload& payload) {
  if (!ip.has(20)) return FrameContent::malformed;
  const std::size_t header = std::size_t{4} * (ip.u8(0) & 0x0f);
  std::size_t total = ip.u16(2);
  if (total == 0) total = ip.on_wire;  // zero with segmentation offload, which sets it later
  if (header < 20 || total < header || total > ip.on_wire || !ip.has(header)) {
    return FrameContent::malformed;
  }
  const std::uint8_t protocol = ip.u8(9);
  if (!is_read(protocol)) return FrameContent::not_udp;
  read_address(ip, 12, false, out.source);
  read_address(ip, 16, false, out.group);
  payload = {ip.first(total).from(header), protocol, std::nullopt};
  const std::uint16_t field = ip.u16(6);
  if ((field & 0x3fff) == 0) return FrameContent::udp;
  payload.fragment.emplace();
  payload.fragment->id = ip.u16(4);
  payload.fragment->offset = std::size_t{8} * (field & 0x1fff);
  payload.fragment->has_more = (field & 0x2000) != 0;
  payload.fragment->octets = payload.octets.at_hand;
  payload.fragment->size = payload.octets.on_wire;
  return FrameContent::udp;
}

// Reads an IPv6 fragment header at the start of `rest`; none if it covers the whole datagram.
std::optional<IpFragment> read_fragment_header(const FrameOctets& rest) {
  const std::uint16_t field = rest.u16(2);
  if ((field & 0xfff9) == 0) return std::nullopt;
  IpFragment fragment;
  fragment.id = std::uint32_t{rest.u16(4)} << 16 | rest.u16(6);
  fragment.offset = field & 0xfff8;
  fragment.has_more = (field & 1) != 0;
  fragment.next = rest.at_hand[0];
  const FrameOctets behind = rest.from(8);
  fragment.octets = behind.at_hand;
  fragment.size = behind.on_wire;
  return fragment;
}

bool is_extension(std::uint8_t header) {
  return header == 0 || header == 43 || header == 44 || header == 51 || header == 60;
}

// Follows the extension headers to UDP, a tunnel, or the octets of a later fragment.
FrameContent read_ipv6(const FrameOctets& ip, SourceDatagram& out, IpPayload& payload) {
  if (!ip.has(40)) return FrameContent::malformed;
  const std::size_t total = std::size_t{40} + ip.u16(4);
  if (total > ip.on_wire) return FrameContent::malformed;
  read_address(ip, 8, true, out.source);
  read_address(ip, 24, true, out.group);
  FrameOctets rest = ip.first(total).from(40);
  payload = {};
  std::size_t next_at = 6;  // offset of the field with the next header's number
  std::uint8_t next = ip.u8(next_at);
  for (int i = 0; i < kMostExtensionHeaders && !is_read(next); ++i) {
    if (!is_extension(next)) return FrameContent::not_udp;
    if (!rest.has(8)) return FrameContent::malformed;
    std::size_t length = 8;
    if (next == 51) length = std::size_t{4} * (rest.u8(1) + std::size_t{2});
    if (next != 44 && next != 51) length = std::size_t{8} * (rest.u8(1) + std::size_t{1});
    if (next == 44 && !payload.fragment) {
      payload.fragment = read_fragment_header(rest);
      if (payload.fragment) payload.fragment->next_at = next_at;
    }
    next = rest.u8(0);
    if (!rest.has(length)) return FrameContent::malformed;
    next_at = total - rest.on_wire;
    rest = rest.from(length);
    // Only the first fragment has headers after the fragment header.
    if (payload.is_later_fragment()) break;
  }
  payload.octets = rest;
  payload.protocol = next;
  const bool may_be_read = payload.is_later_fragment() && is_extension(next);
  return is_read(next) || may_be_read ? FrameContent::udp : FrameContent::not_udp;
}

FrameContent read_udp(const IpPayload& payload, SourceDatagram& out) {
  const FrameOctets& udp = payload.octets;
  // A fragment of a tunnel has no ports either.
  if (payload.is_later_fragment() || payload.protocol != kProtocolUdp) {
    out.portion = Portion::later_fragment;
    out.bytes = udp.at_hand;
    return FrameContent::udp;
  }
  if (!udp.has(kUdpHeader)) return FrameContent::malformed;
  out.source.port = udp.u16(0);
  out.group.port = udp.u16(2);
  const std::size_t length = udp.u16(4);
  if (length < kUdpHeader || (!payload.fragment && length > udp.on_wire)) {
    return FrameContent::malformed;
  }
  const FrameOctets data = udp.first(length).from(kUdpHeader);
  out.bytes = data.at_hand;
  out.portion = payload.fragment                     ? Portion::first_fragment
                : data.at_hand.size() < data.on_wire ? Portion::cut
                                                     : Portion::whole;
  return FrameContent::udp;
}

FrameContent read_ip(const FrameOctets& ip, SourceDatagram& out, IpPayload& payload) {
  if (!ip.has(1)) return FrameContent::malformed;
  const unsigned version = ip.u8(0) >> 4;
  if (version != 4 && version != 6) return FrameContent::not_udp;
  const FrameContent content =
      version == 4 ? read_ipv4(ip, out, payload) : read_ipv6(ip, out, payload);
  // The content of a tunnel is available with its last fragment.
  const bool is_datagram = payload.protocol == kProtocolUdp || payload.fragment.has_value();
  return content == FrameContent::udp && is_datagram ? read_udp(payload, out) : content;
}

/// Content of a whole IP packet that is a tunnel; none if it is the datagram itself.
std::optional<Carried> behind_ip(const IpPayload& payload, const SourceDatagram& datagram) {
  if (payload.protocol == kProtocolGre) return open_gre(payload.octets);
  if (is_tunnel(payload.protocol)) return Carried{Carried::Kind::ip, payload.octets, {}};
  const FrameOctets data = payload.octets.from(kUdpHeader);
  const bool is_mirror = datagram.group.port == kVxlanPort && is_vxlan(data);
  return is_mirror ? std::optional(open_vxlan(data)) : std::nullopt;
}

ParsedFrame with_fragment(IpFragment fragment, std::span<const std::byte> frame,
                          const FrameOctets& ip, bool is_tunnelled) {
  const auto place = [&](std::span<const std::byte> part) {
    return static_cast<std::size_t>(part.data() - frame.data());
  };
  fragment.ip_at = place(ip.at_hand);
  fragment.next_at += fragment.ip_at;
  fragment.octets_at = place(fragment.octets);
  fragment.is_tunnelled = is_tunnelled;
  return {FrameContent::udp, fragment, {}};
}

}  // namespace

ParsedFrame parse_frame(LinkLayer layer, std::span<const std::byte> frame, std::size_t on_wire,
                        SourceDatagram& out) noexcept {
  using Kind = Carried::Kind;
  Carried at = behind_link_layer(layer, {frame, std::max(on_wire, frame.size())});
  for (int tunnels = 0; tunnels <= kMostTunnels; ++tunnels) {
    if (at.kind == Kind::malformed) return {FrameContent::malformed, {}, {}};
    if (at.kind == Kind::nothing || at.kind == Kind::unread)
      return {FrameContent::not_udp, {}, at.name};
    if (at.is_tunnel()) {
      at = open_tunnel(at);
      continue;
    }
    IpPayload payload;
    const FrameContent content = read_ip(at.octets, out, payload);
    if (content != FrameContent::udp) return {content, {}, {}};
    if (payload.fragment) return with_fragment(*payload.fragment, frame, at.octets, tunnels > 0);
    const std::optional<Carried> inner = behind_ip(payload, out);
    if (!inner) return {content, {}, {}};
    at = *inner;
  }
  return {FrameContent::not_udp, {}, "more than 4 nested tunnels"};
}

}  // namespace reckon::peer
