// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a datagram came from, as far as this folder has to know: two of them are equal or not.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace reckon::aoim {

/// UDP source address and port of a datagram. A value.
struct SourceAddress {
  std::array<std::uint8_t, 16> octets{};  ///< an IPv6 address, or an IPv4 one as ::ffff:a.b.c.d
  std::uint16_t port = 0;                 ///< 0: not known, as of a datagram read from a file

  auto operator<=>(const SourceAddress&) const = default;
};

/// Whether a peer pinned to the one address is believed from the other: before its source is known,
/// from any.
[[nodiscard]] constexpr bool may_speak(const SourceAddress& pinned,
                                       const SourceAddress& from) noexcept {
  return pinned.port == 0 || pinned == from;
}

}  // namespace reckon::aoim
