// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Source of a datagram. This folder only compares sources for equality.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace reckon::aoim {

/// UDP source address and port of a datagram, and the boot number that its seal proves. With a seal
/// only the boot number is compared: two sources with one boot are equal, for any addresses. A
/// value type.
struct SourceAddress {
  std::array<std::uint8_t, 16> octets{};  ///< an IPv6 address, or an IPv4 one as ::ffff:a.b.c.d
  std::uint16_t port = 0;                 ///< 0: unknown, for example in a file
  std::uint64_t boot = 0;                 ///< proved by the seal; 0 without a seal

  constexpr bool operator==(const SourceAddress& other) const noexcept {
    return boot == other.boot && (boot != 0 || (octets == other.octets && port == other.port));
  }
  constexpr std::strong_ordering operator<=>(const SourceAddress& other) const noexcept {
    if ((boot | other.boot) != 0) return boot <=> other.boot;
    if (const auto order = octets <=> other.octets; order != 0) return order;
    return port <=> other.port;
  }
};

/// Whether a peer that is bound to the one source is accepted from the other. Any source is
/// accepted while its own is unknown.
[[nodiscard]] constexpr bool may_speak(const SourceAddress& pinned,
                                       const SourceAddress& from) noexcept {
  return pinned.port == 0 || pinned == from;
}

}  // namespace reckon::aoim
