// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Headers between a link layer and an IP packet, and headers of tunnels and mirrors around a
// further frame or packet. Private to the peer library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/peer/capture/frame_octets.hpp"

namespace reckon::peer {

inline constexpr std::uint8_t kProtocolIpv4 = 4;
inline constexpr std::uint8_t kProtocolIpv6 = 41;
inline constexpr std::uint8_t kProtocolGre = 47;
inline constexpr std::uint16_t kVxlanPort = 4789;

/// Whether this IP protocol contains a further frame or packet.
[[nodiscard]] constexpr bool is_tunnel(std::uint8_t protocol) noexcept {
  return protocol == kProtocolIpv4 || protocol == kProtocolIpv6 || protocol == kProtocolGre;
}

/// The content after one or more headers.
struct Carried {
  enum class Kind : std::uint8_t {
    ip,         ///< an IPv4 or IPv6 packet, by its first octet
    mpls,       ///< a stack of labels
    pppoe,      ///< a PPPoE session
    nothing,    ///< no IP
    malformed,  ///< a header is truncated or inconsistent
    unread      ///< it may contain IP, but is not supported
  };
  Kind kind = Kind::nothing;
  FrameOctets octets;     ///< ip, mpls, pppoe
  std::string_view name;  ///< unread: "MPLS", a literal

  [[nodiscard]] bool is_tunnel() const noexcept {
    return kind == Kind::mpls || kind == Kind::pppoe;
  }
};

// None of these functions allocates, or reads beyond the given octets.

/// The content by the EtherType at `type_at`, after the first `header` octets and up to 4 VLAN
/// tags.
[[nodiscard]] Carried behind_ether_type(const FrameOctets& frame, std::size_t type_at,
                                        std::size_t header) noexcept;
/// The same for a frame that begins with its Ethernet addresses.
[[nodiscard]] Carried behind_ethernet(const FrameOctets& frame) noexcept;
/// The content of a tunnel for which is_tunnel() is true.
[[nodiscard]] Carried open_tunnel(const Carried& tunnel) noexcept;
/// The content of a GRE packet (RFC 2784, 2890): IP, Ethernet, MPLS, or a mirrored frame of ERSPAN.
[[nodiscard]] Carried open_gre(const FrameOctets& gre) noexcept;
/// Whether a datagram to kVxlanPort begins as VXLAN (RFC 7348).
[[nodiscard]] bool is_vxlan(const FrameOctets& datagram) noexcept;
/// The content of a VXLAN datagram.
[[nodiscard]] Carried open_vxlan(const FrameOctets& datagram) noexcept;

}  // namespace reckon::peer
