// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/frame_parser.hpp"

#include <algorithm>
#include <cstring>

namespace reckon::peer {
namespace {

constexpr std::uint16_t kTypeIpv4 = 0x0800;
constexpr std::uint16_t kTypeIpv6 = 0x86dd;
constexpr std::uint8_t kProtocolUdp = 17;
constexpr std::size_t kUdpHeader = 8;
constexpr int kMaxTags = 4;               // VLAN tags in a row
constexpr int kMaxExtensionHeaders = 16;  // of IPv6

// Octets of a frame: the captured ones, and their number on the wire.
struct Octets {
  std::span<const std::byte> at_hand;
  std::size_t on_wire;

  [[nodiscard]] bool has(std::size_t count) const { return at_hand.size() >= count; }
  [[nodiscard]] std::uint8_t u8(std::size_t at) const {
    return std::to_integer<std::uint8_t>(at_hand[at]);
  }
  [[nodiscard]] std::uint16_t u16(std::size_t at) const {
    return static_cast<std::uint16_t>((u8(at) << 8) | u8(at + 1));
  }
  [[nodiscard]] Octets from(std::size_t at) const { return {at_hand.subspan(at), on_wire - at}; }
  // Only the first `count` octets of the wire: the rest is padding.
  [[nodiscard]] Octets first(std::size_t count) const {
    return {at_hand.first(std::min(count, at_hand.size())), std::min(count, on_wire)};
  }
};

// The payload as described by the IP headers.
struct IpPayload {
  Octets octets;
  std::optional<IpFragment> fragment;

  [[nodiscard]] bool is_later_fragment() const { return fragment && fragment->offset > 0; }
};

constexpr std::size_t kNoIp = 0xffff;

bool is_tag(std::uint16_t type) { return type == 0x8100 || type == 0x88a8 || type == 0x9100; }

// Octets before the IP header, kNoIp if it is not IP; false if the frame is too short. The type at
// `type_at` belongs to what follows the first `header` octets; VLAN tags have two octets and again
// a type.
bool skip_tags(const Octets& frame, std::size_t type_at, std::size_t& header) {
  for (int tags = 0; tags <= kMaxTags; ++tags) {
    if (!frame.has(std::max(type_at + 2, header))) return false;
    const std::uint16_t type = frame.u16(type_at);
    if (type == kTypeIpv4 || type == kTypeIpv6) return true;
    if (!is_tag(type)) break;
    type_at = header + 2;
    header += 4;
  }
  header = kNoIp;
  return true;
}

bool skip_link_layer(LinkLayer layer, const Octets& frame, std::size_t& header) {
  switch (layer) {
    case LinkLayer::ethernet:
      header = 14;
      return skip_tags(frame, 12, header);
    case LinkLayer::linux_cooked:
      header = 16;
      return skip_tags(frame, 14, header);
    case LinkLayer::linux_cooked_2:
      header = 20;
      return skip_tags(frame, 0, header);
    // The family number differs between systems and octet orders; the IP version identifies the
    // family too.
    case LinkLayer::bsd_loopback:
      header = 4;
      return frame.has(4);
    case LinkLayer::raw_ip:
      header = 0;
      return true;
  }
  return false;
}

void read_address(const Octets& ip, std::size_t at, bool ipv6, IpEndpoint& out) {
  out = {};
  out.is_v6 = ipv6;
  std::memcpy(out.octets.data(), ip.at_hand.data() + at, ipv6 ? 16 : 4);
}

FrameContent read_ipv4(const Octets& ip, SourceDatagram& out, IpPayload& payload) {
  if (!ip.has(20)) return FrameContent::malformed;
  const std::size_t header = std::size_t{4} * (ip.u8(0) & 0x0f);
  std::size_t total = ip.u16(2);
  if (total == 0) total = ip.on_wire;  // filled in later by a network card that segments
  if (header < 20 || total < header || total > ip.on_wire || !ip.has(header)) {
    return FrameContent::malformed;
  }
  if (ip.u8(9) != kProtocolUdp) return FrameContent::not_udp;
  read_address(ip, 12, false, out.source);
  read_address(ip, 16, false, out.group);
  payload = {ip.first(total).from(header), std::nullopt};
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

// An IPv6 fragment header at the front of `rest`; none if it covers the whole datagram.
std::optional<IpFragment> read_fragment_header(const Octets& rest) {
  const std::uint16_t field = rest.u16(2);
  if ((field & 0xfff9) == 0) return std::nullopt;
  IpFragment fragment;
  fragment.id = std::uint32_t{rest.u16(4)} << 16 | rest.u16(6);
  fragment.offset = field & 0xfff8;
  fragment.has_more = (field & 1) != 0;
  fragment.next = rest.at_hand[0];
  const Octets behind = rest.from(8);
  fragment.octets = behind.at_hand;
  fragment.size = behind.on_wire;
  return fragment;
}

bool is_extension(std::uint8_t header) {
  return header == 0 || header == 43 || header == 44 || header == 51 || header == 60;
}

// Walks through the extension headers to UDP, or to the octets of a later fragment.
FrameContent read_ipv6(const Octets& ip, SourceDatagram& out, IpPayload& payload) {
  if (!ip.has(40)) return FrameContent::malformed;
  const std::size_t total = std::size_t{40} + ip.u16(4);
  if (total > ip.on_wire) return FrameContent::malformed;
  read_address(ip, 8, true, out.source);
  read_address(ip, 24, true, out.group);
  Octets rest = ip.first(total).from(40);
  payload = {};
  std::size_t next_at = 6;  // octet of the packet that names the next header
  std::uint8_t next = ip.u8(next_at);
  for (int i = 0; i < kMaxExtensionHeaders && next != kProtocolUdp; ++i) {
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
    // What follows the extension headers stands in the first fragment alone.
    if (payload.is_later_fragment()) break;
  }
  payload.octets = rest;
  const bool may_be_udp = payload.is_later_fragment() && is_extension(next);
  return next == kProtocolUdp || may_be_udp ? FrameContent::udp : FrameContent::not_udp;
}

FrameContent read_udp(const IpPayload& payload, SourceDatagram& out) {
  const Octets& udp = payload.octets;
  if (payload.is_later_fragment()) {
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
  const Octets data = udp.first(length).from(kUdpHeader);
  out.bytes = data.at_hand;
  out.portion = payload.fragment                     ? Portion::first_fragment
                : data.at_hand.size() < data.on_wire ? Portion::cut
                                                     : Portion::whole;
  return FrameContent::udp;
}

}  // namespace

ParsedFrame parse_frame(LinkLayer layer, std::span<const std::byte> frame, std::size_t on_wire,
                        SourceDatagram& out) noexcept {
  const Octets all{frame, std::max(on_wire, frame.size())};
  std::size_t header = 0;
  if (!skip_link_layer(layer, all, header)) return {FrameContent::malformed, {}};
  if (header == kNoIp) return {FrameContent::not_udp, {}};
  if (!all.has(header + 1)) return {FrameContent::malformed, {}};
  const Octets ip = all.from(header);
  IpPayload payload{};
  const unsigned version = ip.u8(0) >> 4;
  if (version != 4 && version != 6) return {FrameContent::not_udp, {}};
  FrameContent content = version == 4 ? read_ipv4(ip, out, payload) : read_ipv6(ip, out, payload);
  if (content == FrameContent::udp) content = read_udp(payload, out);
  if (content != FrameContent::udp || !payload.fragment) return {content, {}};
  payload.fragment->ip_at = header;
  payload.fragment->next_at += header;
  payload.fragment->octets_at =
      static_cast<std::size_t>(payload.fragment->octets.data() - frame.data());
  return {content, payload.fragment};
}

}  // namespace reckon::peer
