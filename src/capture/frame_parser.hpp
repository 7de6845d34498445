// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Parses a captured frame down to its UDP payload: link layers, VLAN tags, IPv4 and IPv6 headers,
// and surrounding tunnels and mirrors.
// Private to the peer library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::peer {

/// First layer of a frame.
enum class LinkLayer : std::uint8_t {
  ethernet,
  raw_ip,
  linux_cooked,
  linux_cooked_2,
  bsd_loopback
};

/// Content of a frame.
enum class FrameContent : std::uint8_t { udp, not_udp, malformed };

/// An IP fragment and its position in its frame.
struct IpFragment {
  std::uint32_t id{0};                ///< common to the fragments of one datagram
  std::size_t offset{0};              ///< of its first octet in the datagram's IP payload
  std::size_t size{0};                ///< octets on the wire
  bool has_more{false};               ///< another fragment follows
  std::span<const std::byte> octets;  ///< the part that the capture kept
  std::size_t ip_at{0};               ///< octet of the frame at which the IP header begins
  std::size_t octets_at{0};           ///< octet of the frame at which its octets begin
  std::size_t next_at{0};    ///< IPv6: octet of the frame with the number of the fragment header
  std::byte next{};          ///< IPv6: number of the header after the fragment header
  bool is_tunnelled{false};  ///< the octets before ip_at do not describe the whole packet
};

/// Result of parsing a frame.
struct ParsedFrame {
  FrameContent content{FrameContent::not_udp};
  std::optional<IpFragment> fragment;  ///< only with content udp
  /// Only with content not_udp: name of a protocol that may contain UDP, but is not supported
  /// ("MPLS"); a literal.
  std::string_view unread;
};

/// Finds the UDP payload of one frame; `on_wire` is its length before the capture truncated it
/// [octets]. Fills source, group, bytes and portion of `out`. Reads only inside `frame`, for any
/// octets, and allocates nothing.
///
/// Inside VXLAN, ERSPAN and other GRE, IP in IP, PPPoE and MPLS it finds the inner datagram, up to
/// 4 tunnels deep; source and group are taken from the inner packet. Fragments of a tunnel's outer
/// packet are returned as fragments without ports.
[[nodiscard]] ParsedFrame parse_frame(LinkLayer layer, std::span<const std::byte> frame,
                                      std::size_t on_wire, SourceDatagram& out) noexcept;

}  // namespace reckon::peer
