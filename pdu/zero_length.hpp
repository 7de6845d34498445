// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// PDUs whose sender left the length field at 0. Such a PDU extends to the end of its datagram.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/pdu/bundle.hpp"

namespace reckon::pdu {

/// Offset of the PDU with a length field of 0, if the datagram has one; it is the last PDU. It must
/// have a header of a supported version, and at most 65,535 octets.
[[nodiscard]] inline std::optional<std::size_t> find_zero_length(
    std::span<const std::byte> datagram) noexcept {
  for (const BundledPdu& pdu : BundleReader(datagram)) {
    if (pdu.error == DecodeError::length && pdu.header.length == 0 &&
        pdu.bytes.size() <= kMaxPduSize)
      return pdu.offset;
  }
  return std::nullopt;
}

/// Writes the length field of the PDU at `offset`, which must have a header.
inline void set_length(std::span<std::byte> datagram, std::size_t offset,
                       std::uint16_t length) noexcept {
  constexpr std::size_t kLengthAt = 8;  // in the header
  store_big_endian(datagram.data() + offset + kLengthAt, length);
}

}  // namespace reckon::pdu
