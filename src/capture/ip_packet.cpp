// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes the IP packet for a UDP payload and its endpoints.
#include <algorithm>
#include <array>
#include <cstring>

#include "reckon/peer/capture/capture_writer.hpp"
#include "reckon/peer/capture/internet_checksum.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kUdpHeader = 8;
constexpr std::size_t kMaxPacket = 65535;
constexpr std::uint8_t kProtocolUdp = 17;

void put_u16(std::span<std::byte> at, std::size_t value) {
  at[0] = static_cast<std::byte>(value >> 8);
  at[1] = static_cast<std::byte>(value);
}

void put_address(std::span<std::byte> at, const IpEndpoint& endpoint, std::size_t size) {
  std::memcpy(at.data(), endpoint.octets.data(), size);
}

void put_ipv4_header(std::span<std::byte> ip, const SourceDatagram& datagram) {
  ip[0] = std::byte{0x45};
  put_u16(ip.subspan(2), ip.size());
  ip[6] = std::byte{0x40};  // do not fragment
  ip[8] = std::byte{1};     // hops
  ip[9] = std::byte{kProtocolUdp};
  put_address(ip.subspan(12), datagram.source, 4);
  put_address(ip.subspan(16), datagram.group, 4);
  const std::uint16_t sum = folded(word_sum(ip.first(20)));
  std::memcpy(ip.data() + 10, &sum, 2);
}

void put_ipv6_header(std::span<std::byte> ip, const SourceDatagram& datagram) {
  ip[0] = std::byte{0x60};
  put_u16(ip.subspan(4), ip.size() - 40);
  ip[6] = std::byte{kProtocolUdp};
  ip[7] = std::byte{1};
  put_address(ip.subspan(8), datagram.source, 16);
  put_address(ip.subspan(24), datagram.group, 16);
}

}  // namespace

void make_ip_packet(const SourceDatagram& datagram, std::vector<std::byte>& out) {
  const bool ipv6 = datagram.group.is_v6;
  const std::size_t header = ipv6 ? 40 : 20;
  const std::size_t room = (ipv6 ? kMaxPacket : kMaxPacket - header) - kUdpHeader;
  const auto payload = datagram.bytes.first(std::min(datagram.bytes.size(), room));
  const std::size_t udp_length = kUdpHeader + payload.size();
  out.assign(header + udp_length, std::byte{0});

  const std::span<std::byte> ip(out);
  ipv6 ? put_ipv6_header(ip, datagram) : put_ipv4_header(ip, datagram);

  const std::span<std::byte> udp = ip.subspan(header);
  put_u16(udp, datagram.source.port);
  put_u16(udp.subspan(2), datagram.group.port);
  put_u16(udp.subspan(4), udp_length);
  std::copy(payload.begin(), payload.end(), udp.begin() + kUdpHeader);

  // The checksum covers the addresses, the protocol and the length too (RFC 768, RFC 8200 8.1).
  std::array<std::byte, 4> tail{std::byte{0}, std::byte{kProtocolUdp}};
  put_u16(std::span(tail).subspan(2), udp_length);
  const std::size_t addresses = ipv6 ? 8 : 12;
  std::uint16_t sum =
      folded(word_sum(ip.subspan(addresses, header - addresses)) + word_sum(tail) + word_sum(udp));
  if (sum == 0) sum = 0xffff;  // zero would mean: no checksum
  std::memcpy(udp.data() + 6, &sum, 2);
}

}  // namespace reckon::peer
