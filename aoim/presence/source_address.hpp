// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whom a datagram came from, as far as this folder has to know: two of them are equal or not.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace reckon::aoim {

/// UDP source address and port of a datagram, and who has proved to have sent it. A value. Where
/// somebody has, that alone decides who it is: two of one boot are equal, from wherever they come.
struct SourceAddress {
  std::array<std::uint8_t, 16> octets{};  ///< an IPv6 address, or an IPv4 one as ::ffff:a.b.c.d
  std::uint16_t port = 0;                 ///< 0: not known, as of a datagram read from a file
  std::uint64_t boot = 0;                 ///< proved by the seal; 0 where nothing is sealed

  constexpr bool operator==(const SourceAddress& other) const noexcept {
    return boot == other.boot && (boot != 0 || (octets == other.octets && port == other.port));
  }
  constexpr std::strong_ordering operator<=>(const SourceAddress& other) const noexcept {
    if ((boot | other.boot) != 0) return boot <=> other.boot;
    if (const auto order = octets <=> other.octets; order != 0) return order;
    return port <=> other.port;
  }
};

/// Whether a peer pinned to the one address is believed from the other: before its source is known,
/// from any.
[[nodiscard]] constexpr bool may_speak(const SourceAddress& pinned,
                                       const SourceAddress& from) noexcept {
  return pinned.port == 0 || pinned == from;
}

}  // namespace reckon::aoim
