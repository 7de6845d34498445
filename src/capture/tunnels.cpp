// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/capture/tunnels.hpp"

namespace reckon::peer {
namespace {

using Kind = Carried::Kind;

constexpr std::size_t kEthernetHeader = 14;
constexpr int kMostVlanTags = 4;     // in a row
constexpr int kMostMplsLabels = 16;  // in a stack
constexpr std::size_t kVxlanHeader = 8;

constexpr std::uint16_t kEtherIpv4 = 0x0800;
constexpr std::uint16_t kEtherIpv6 = 0x86dd;
constexpr std::uint16_t kEtherPppoe = 0x8864;
constexpr std::uint16_t kEtherBridged = 0x6558;
constexpr std::uint16_t kEtherErspan = 0x88be;
constexpr std::uint16_t kEtherErspan3 = 0x22eb;

bool is_vlan(std::uint16_t type) { return type == 0x8100 || type == 0x88a8 || type == 0x9100; }
bool is_mpls(std::uint16_t type) { return type == 0x8847 || type == 0x8848; }

constexpr Carried kMalformed{Kind::malformed, {}, {}};
Carried unread(std::string_view name) { return {Kind::unread, {}, name}; }

/// The content after the first `header` octets, by its EtherType.
Carried by_type(const FrameOctets& frame, std::uint16_t type, std::size_t header) {
  Kind kind = Kind::nothing;
  if (type == kEtherIpv4 || type == kEtherIpv6) kind = Kind::ip;
  if (is_mpls(type)) kind = Kind::mpls;
  if (type == kEtherPppoe) kind = Kind::pppoe;
  if (kind == Kind::nothing) return {};
  return frame.has(header) ? Carried{kind, frame.from(header), {}} : kMalformed;
}

Carried open_mpls(const FrameOctets& labels) {
  constexpr std::size_t kLabel = 4;
  constexpr std::size_t kControlWord = 4;
  std::size_t at = 0;
  bool is_bottom = false;
  for (int i = 0; i < kMostMplsLabels && !is_bottom; ++i, at += kLabel) {
    if (!labels.has(at + kLabel)) return kMalformed;
    is_bottom = (labels.u8(at + 2) & 1) != 0;
  }
  if (!is_bottom) return unread("MPLS");
  if (!labels.has(at + 1)) return kMalformed;
  // Labels do not identify their content. Its first four bits distinguish IPv4, IPv6 and the
  // control word before Ethernet (RFC 4385).
  const unsigned version = labels.u8(at) >> 4;
  if (version == 4 || version == 6) return {Kind::ip, labels.from(at), {}};
  if (version != 0) return unread("MPLS");
  return labels.has(at + kControlWord) ? behind_ethernet(labels.from(at + kControlWord))
                                       : kMalformed;
}

Carried open_pppoe(const FrameOctets& session) {
  constexpr std::size_t kHeader = 6;
  if (!session.has(kHeader + 2)) return kMalformed;
  const std::size_t length = session.u16(4);
  if (session.u8(0) != 0x11 || length < 2 || length > session.on_wire - kHeader) return kMalformed;
  const FrameOctets ppp = session.from(kHeader).first(length);
  switch (ppp.u16(0)) {
    case 0x0021:
    case 0x0057:
      return {Kind::ip, ppp.from(2), {}};
    case 0x0281:
    case 0x0283:
      return {Kind::mpls, ppp.from(2), {}};
    case 0x0053:
    case 0x00fd:
      return unread("compressed or encrypted PPPoE");
    default:
      return {};  // link control
  }
}

/// A mirrored frame after the header of ERSPAN type II or III; type I has no header.
Carried open_erspan(const FrameOctets& mirrored, std::uint16_t type, bool has_sequence) {
  if (type == kEtherErspan && !has_sequence) return behind_ethernet(mirrored);
  if (!mirrored.has(12)) return kMalformed;
  const unsigned version = mirrored.u8(0) >> 4;
  if (version != (type == kEtherErspan ? 1U : 2U)) return unread("ERSPAN");
  std::size_t header = 8;
  if (type == kEtherErspan3) header = (mirrored.u8(11) & 1) != 0 ? 20 : 12;
  return mirrored.has(header) ? behind_ethernet(mirrored.from(header)) : kMalformed;
}

}  // namespace

Carried behind_ether_type(const FrameOctets& frame, std::size_t type_at,
                          std::size_t header) noexcept {
  for (int tags = 0; tags <= kMostVlanTags; ++tags) {
    if (!frame.has(std::max(type_at + 2, header))) return kMalformed;
    const std::uint16_t type = frame.u16(type_at);
    // A tag has two octets, followed by another type.
    if (!is_vlan(type)) return by_type(frame, type, header);
    type_at = header + 2;
    header += 4;
  }
  return {};
}

Carried behind_ethernet(const FrameOctets& frame) noexcept {
  return behind_ether_type(frame, kEthernetHeader - 2, kEthernetHeader);
}

Carried open_tunnel(const Carried& tunnel) noexcept {
  return tunnel.kind == Kind::mpls ? open_mpls(tunnel.octets) : open_pppoe(tunnel.octets);
}

Carried open_gre(const FrameOctets& gre) noexcept {
  if (!gre.has(4)) return kMalformed;
  const std::uint16_t flags = gre.u16(0);
  const std::uint16_t type = gre.u16(2);
  constexpr unsigned kChecksum = 0x8000, kRouting = 0x4000, kKey = 0x2000, kSequence = 0x1000;
  if ((flags & 7) == 1) return unread("GRE of PPTP");
  if ((flags & 7) != 0 || (flags & kRouting) != 0) return unread("GRE with routing");
  std::size_t header = 4;
  for (const unsigned flag : {kChecksum, kKey, kSequence}) header += (flags & flag) != 0 ? 4 : 0;
  if (!gre.has(header)) return kMalformed;
  if (type == kEtherBridged) return behind_ethernet(gre.from(header));
  if (type == kEtherErspan || type == kEtherErspan3)
    return open_erspan(gre.from(header), type, (flags & kSequence) != 0);
  return by_type(gre, type, header);
}

bool is_vxlan(const FrameOctets& datagram) noexcept {
  return datagram.has(kVxlanHeader) && (datagram.u8(0) & 0x08) != 0;
}

Carried open_vxlan(const FrameOctets& datagram) noexcept {
  return behind_ethernet(datagram.from(kVxlanHeader));
}

}  // namespace reckon::peer
