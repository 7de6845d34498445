// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What stands in front of a datagram that goes to each address of a list: to which group it was
// said. It has the shape of an experimental PDU, so that whoever does not know it steps over it by
// its length. docs/transport.md has its table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/pdu/codec/pdu_header.hpp"

namespace reckon::peer {

inline constexpr std::size_t kUnicastFrameSize = 16;  ///< octets
inline constexpr std::uint8_t kUnicastFrameType = 148;

/// @param group 0: the base group; n: the n-th of the pool
[[nodiscard]] constexpr std::array<std::byte, kUnicastFrameSize> unicast_frame(
    std::uint8_t exercise, std::uint16_t group) noexcept {
  constexpr std::uint8_t kVersion = 7, kFamily = 129;
  std::array<std::byte, kUnicastFrameSize> octets{};
  octets[0] = std::byte{kVersion};
  octets[1] = std::byte{exercise};
  octets[2] = std::byte{kUnicastFrameType};
  octets[3] = std::byte{kFamily};
  octets[9] = std::byte{kUnicastFrameSize};  // of the length; its upper octet is 0
  octets[12] = static_cast<std::byte>(group >> 8);
  octets[13] = static_cast<std::byte>(group & 0xff);
  return octets;
}

/// The group that a datagram says in front; nothing where it says none.
[[nodiscard]] constexpr std::optional<std::uint16_t> unicast_group_of(
    std::span<const std::byte> datagram) noexcept {
  const auto octet = [&](std::size_t at) { return std::to_integer<unsigned>(datagram[at]); };
  if (datagram.size() < kUnicastFrameSize) return {};
  const bool is_frame = pdu::is_supported_version(static_cast<std::uint8_t>(octet(0))) &&
                        octet(2) == kUnicastFrameType && octet(8) == 0 &&
                        octet(9) == kUnicastFrameSize;
  if (!is_frame) return {};
  return static_cast<std::uint16_t>(octet(12) << 8 | octet(13));
}

}  // namespace reckon::peer
