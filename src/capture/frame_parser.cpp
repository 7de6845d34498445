// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Parses a captured frame down to its UDP payload: link layers, VLAN tags, IPv4 and IPv6 headers.
#include <algorithm>
#include <cstring>

#include "reckon/peer/capture/capture_file.hpp"

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

// The payload as described by the IP header.
struct IpPayload {
  Octets octets;
  bool fragmented{false};
  bool first_fragment{false};
};

// Octets before the IP header, 0xffff if it is not IP; false if the frame is too short.
bool skip_ethernet(const Octets& frame, std::size_t& header) {
  header = 14;
  std::size_t type_at = 12;
  for (int tags = 0; tags < kMaxTags; ++tags) {
    if (!frame.has(type_at + 2)) return false;
    const std::uint16_t type = frame.u16(type_at);
    if (type == kTypeIpv4 || type == kTypeIpv6) return true;
    if (type != 0x8100 && type != 0x88a8 && type != 0x9100) break;
    type_at += 4;
    header += 4;
  }
  header = 0xffff;
  return true;
}

bool skip_cooked(const Octets& frame, std::size_t type_at, std::size_t length,
                 std::size_t& header) {
  if (!frame.has(length)) return false;
  const std::uint16_t type = frame.u16(type_at);
  header = type == kTypeIpv4 || type == kTypeIpv6 ? length : 0xffff;
  return true;
}

bool skip_link_layer(LinkLayer layer, const Octets& frame, std::size_t& header) {
  switch (layer) {
    case LinkLayer::ethernet:
      return skip_ethernet(frame, header);
    case LinkLayer::linux_cooked:
      return skip_cooked(frame, 14, 16, header);
    case LinkLayer::linux_cooked_2:
      return skip_cooked(frame, 0, 20, header);
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
  const std::uint16_t fragment = ip.u16(6);
  const bool more = (fragment & 0x2000) != 0;
  const bool first = (fragment & 0x1fff) == 0;
  payload = {ip.first(total).from(header), more || !first, first};
  return FrameContent::udp;
}

// Walks through the extension headers to UDP.
FrameContent read_ipv6(const Octets& ip, SourceDatagram& out, IpPayload& payload) {
  if (!ip.has(40)) return FrameContent::malformed;
  const std::size_t total = std::size_t{40} + ip.u16(4);
  if (total > ip.on_wire) return FrameContent::malformed;
  read_address(ip, 8, true, out.source);
  read_address(ip, 24, true, out.group);
  std::uint8_t next = ip.u8(6);
  Octets rest = ip.first(total).from(40);
  payload = {};
  for (int i = 0; i < kMaxExtensionHeaders && next != kProtocolUdp; ++i) {
    const bool options = next == 0 || next == 43 || next == 60;
    if (!options && next != 44 && next != 51) return FrameContent::not_udp;
    if (!rest.has(8)) return FrameContent::malformed;
    std::size_t length = 8;
    if (options) length = std::size_t{8} * (rest.u8(1) + std::size_t{1});
    if (next == 51) length = std::size_t{4} * (rest.u8(1) + std::size_t{2});
    if (next == 44) {
      payload.fragmented = (rest.u16(2) & 0xfff9) != 0;
      payload.first_fragment = (rest.u16(2) & 0xfff8) == 0;
    }
    next = rest.u8(0);
    if (!rest.has(length)) return FrameContent::malformed;
    rest = rest.from(length);
    if (payload.fragmented && !payload.first_fragment) break;
  }
  payload.octets = rest;
  return next == kProtocolUdp ? FrameContent::udp : FrameContent::not_udp;
}

FrameContent read_udp(const IpPayload& payload, SourceDatagram& out) {
  const Octets& udp = payload.octets;
  if (payload.fragmented && !payload.first_fragment) {
    out.portion = Portion::later_fragment;
    out.bytes = udp.at_hand;
    return FrameContent::udp;
  }
  if (!udp.has(kUdpHeader)) return FrameContent::malformed;
  out.source.port = udp.u16(0);
  out.group.port = udp.u16(2);
  const std::size_t length = udp.u16(4);
  if (length < kUdpHeader || (!payload.fragmented && length > udp.on_wire)) {
    return FrameContent::malformed;
  }
  const Octets data = udp.first(length).from(kUdpHeader);
  out.bytes = data.at_hand;
  out.portion = payload.fragmented                   ? Portion::first_fragment
                : data.at_hand.size() < data.on_wire ? Portion::cut
                                                     : Portion::whole;
  return FrameContent::udp;
}

}  // namespace

FrameContent parse_frame(LinkLayer layer, std::span<const std::byte> frame, std::size_t on_wire,
                         SourceDatagram& out) noexcept {
  const Octets all{frame, std::max(on_wire, frame.size())};
  std::size_t header = 0;
  if (!skip_link_layer(layer, all, header)) return FrameContent::malformed;
  if (header == 0xffff) return FrameContent::not_udp;
  if (!all.has(header + 1)) return FrameContent::malformed;
  const Octets ip = all.from(header);
  IpPayload payload{};
  const unsigned version = ip.u8(0) >> 4;
  if (version != 4 && version != 6) return FrameContent::not_udp;
  const FrameContent content =
      version == 4 ? read_ipv4(ip, out, payload) : read_ipv6(ip, out, payload);
  return content == FrameContent::udp ? read_udp(payload, out) : content;
}

}  // namespace reckon::peer
