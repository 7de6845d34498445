// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams cut into IP fragments, as frames of a capture.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "reckon/tests/src/support/made_frames.hpp"

namespace reckon::peer::frames {

/// Octets of a fragment in Ethernet with an MTU of 1500.
inline constexpr std::size_t kPiece = 1480;

/// A datagram with `payload` numbered octets, from port 3001 to 3000: UDP header and payload.
inline Bytes numbered_udp(std::size_t payload, std::size_t number = 0) {
  Bytes out = udp(payload);
  for (std::size_t i = 8; i < out.size(); ++i)
    out[i] = static_cast<std::uint8_t>(i * 7 + i / 251 + number);
  return out;
}

/// One fragment of `datagram` in IPv4 and Ethernet.
inline Bytes fragment4(const Bytes& datagram, std::size_t id, std::size_t offset,
                       std::size_t size = kPiece) {
  const auto begin = datagram.begin() + static_cast<std::ptrdiff_t>(offset);
  const std::size_t end = std::min(offset + size, datagram.size());
  const Bytes octets(begin, datagram.begin() + static_cast<std::ptrdiff_t>(end));
  const std::size_t more = end < datagram.size() ? 0x2000 : 0;
  Bytes packet = ipv4(octets, 17, offset / 8 | more);
  packet[4] = static_cast<std::uint8_t>(id >> 8);
  packet[5] = static_cast<std::uint8_t>(id);
  return ethernet(packet);
}

/// The same in IPv6, behind a fragment header.
inline Bytes fragment6(const Bytes& datagram, std::size_t id, std::size_t offset,
                       std::size_t size = kPiece) {
  const auto begin = datagram.begin() + static_cast<std::ptrdiff_t>(offset);
  const std::size_t end = std::min(offset + size, datagram.size());
  const Bytes octets(begin, datagram.begin() + static_cast<std::ptrdiff_t>(end));
  const std::size_t more = end < datagram.size() ? 1 : 0;
  const Bytes header = Bytes{17, 0} + u16(offset | more) + u16(id >> 16) + u16(id & 0xffff);
  return ethernet(ipv6(header + octets, 44), 0x86dd);
}

/// All fragments, in order.
template <typename Fragment>
std::vector<Bytes> fragments(const Bytes& datagram, std::size_t id, const Fragment& fragment) {
  std::vector<Bytes> out;
  for (std::size_t offset = 0; offset < datagram.size(); offset += kPiece)
    out.push_back(fragment(datagram, id, offset, kPiece));
  return out;
}

}  // namespace reckon::peer::frames
