// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The checksum of IPv4 headers and UDP (RFC 1071). Private to the peer library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace reckon::peer {

/// Sum of 16-bit words in the host's byte order: by RFC 1071 2 (B) the order does not matter.
[[nodiscard]] inline std::uint64_t word_sum(std::span<const std::byte> octets) noexcept {
  std::uint64_t sum = 0;
  std::size_t at = 0;
  for (; at + 4 <= octets.size(); at += 4) {
    std::uint32_t word;
    std::memcpy(&word, octets.data() + at, 4);
    sum += word;
  }
  std::uint32_t rest = 0;
  std::memcpy(&rest, octets.data() + at, octets.size() - at);
  return sum + rest;
}

/// The checksum of RFC 1071, to be stored in the host's byte order.
[[nodiscard]] inline std::uint16_t folded(std::uint64_t sum) noexcept {
  while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

}  // namespace reckon::peer
