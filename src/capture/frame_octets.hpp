// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The octets of a captured frame, or of a part of it. Private to the peer library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::peer {

/// The captured octets, and their number on the wire, which is never smaller. Each read needs
/// has() before it.
struct FrameOctets {
  std::span<const std::byte> at_hand;
  std::size_t on_wire = 0;

  [[nodiscard]] bool has(std::size_t count) const { return at_hand.size() >= count; }
  [[nodiscard]] std::uint8_t u8(std::size_t at) const {
    return std::to_integer<std::uint8_t>(at_hand[at]);
  }
  [[nodiscard]] std::uint16_t u16(std::size_t at) const {
    return static_cast<std::uint16_t>((u8(at) << 8) | u8(at + 1));
  }
  [[nodiscard]] FrameOctets from(std::size_t at) const {
    return {at_hand.subspan(at), on_wire - at};
  }
  /// Only the first `count` octets on the wire; the rest is padding.
  [[nodiscard]] FrameOctets first(std::size_t count) const {
    return {at_hand.first(std::min(count, at_hand.size())), std::min(count, on_wire)};
  }
};

}  // namespace reckon::peer
