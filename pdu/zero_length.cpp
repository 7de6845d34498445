// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/zero_length.hpp"

#include "reckon/pdu/bundle.hpp"

namespace reckon::pdu {

std::optional<std::size_t> find_zero_length(std::span<const std::byte> datagram) noexcept {
  for (const BundledPdu& pdu : BundleReader(datagram)) {
    if (pdu.error == DecodeError::length && pdu.header.length == 0 &&
        pdu.bytes.size() <= kMaxPduSize)
      return pdu.offset;
  }
  return std::nullopt;
}

void set_length(std::span<std::byte> datagram, std::size_t offset, std::uint16_t length) noexcept {
  constexpr std::size_t kLengthAt = 8;  // in the header
  store_big_endian(datagram.data() + offset + kLengthAt, length);
}

}  // namespace reckon::pdu
