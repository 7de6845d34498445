// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Captured frames, built octet by octet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace reckon::peer::frames {

using Bytes = std::vector<std::uint8_t>;

/// Concatenates.
inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Big endian.
inline Bytes u16(std::size_t value) {
  return {static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}

/// From port 3001 to 3000, with `length_field` octets in the length field of the header.
inline Bytes udp(std::size_t payload, std::size_t length_field) {
  return u16(3001) + u16(3000) + u16(length_field) + u16(0) + Bytes(payload, 0x5a);
}
/// With the correct length.
inline Bytes udp(std::size_t payload) { return udp(payload, payload + 8); }

/// From 10.0.0.1 to 239.1.2.3.
inline Bytes ipv4(const Bytes& payload, std::uint8_t protocol = 17, std::size_t fragment = 0) {
  return Bytes{0x45, 0} + u16(20 + payload.size()) + u16(1) + u16(fragment) +
         Bytes{1, protocol, 0, 0, 10, 0, 0, 1, 239, 1, 2, 3} + payload;
}

/// From fd00::7 to ff15::.
inline Bytes ipv6(const Bytes& payload, std::uint8_t next = 17) {
  Bytes out = Bytes{0x60, 0, 0, 0} + u16(payload.size()) + Bytes{next, 1} + Bytes(32, 0) + payload;
  out[8] = 0xfd;
  out[23] = 7;
  out[24] = 0xff;
  out[25] = 0x15;
  return out;
}

/// Behind an Ethernet header.
inline Bytes ethernet(const Bytes& payload, std::size_t type = 0x0800) {
  return Bytes(12, 1) + u16(type) + payload;
}

/// A frame in a VXLAN of the network 7 (RFC 7348).
inline Bytes vxlan(const Bytes& frame) {
  const Bytes head = Bytes{8, 0, 0, 0, 0, 0, 7, 0};
  return ipv4(u16(49152) + u16(4789) + u16(16 + frame.size()) + u16(0) + head + frame);
}
/// Content of this EtherType in GRE (RFC 2784).
inline Bytes gre(const Bytes& content, std::size_t type, std::size_t flags = 0) {
  return ipv4(u16(flags) + u16(type) + content, 47);
}
/// A frame mirrored by ERSPAN of type 2, or 3 with its platform header.
inline Bytes erspan(const Bytes& frame, int type) {
  const Bytes sequence = Bytes{0, 0, 0, 9};
  if (type == 2) return gre(sequence + Bytes{0x10, 1, 0, 0, 0, 0, 0, 0} + frame, 0x88be, 0x1000);
  return gre(sequence + Bytes{0x20, 1} + Bytes(9, 0) + Bytes{1} + Bytes(8, 0) + frame, 0x22eb,
             0x1000);
}
/// A packet in a PPPoE session (RFC 2516).
inline Bytes pppoe(const Bytes& packet, std::size_t protocol = 0x0021) {
  return ethernet(Bytes{0x11, 0} + u16(3) + u16(packet.size() + 2) + u16(protocol) + packet,
                  0x8864);
}
/// Content behind two labels of MPLS (RFC 3032).
inline Bytes mpls(const Bytes& content) {
  return ethernet(Bytes{0, 1, 0, 64, 0, 1, 17, 64} + content, 0x8847);
}

}  // namespace reckon::peer::frames
