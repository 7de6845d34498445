// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/zero_length.hpp"

#include "reckon/pdu/bundle.hpp"

namespace reckon::tools {

std::optional<std::size_t> find_zero_length(std::span<const std::byte> datagram) noexcept {
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram)) {
    if (pdu.error == pdu::DecodeError::length && pdu.header.length == 0 &&
        pdu.bytes.size() <= pdu::kMaxPduSize)
      return pdu.offset;
  }
  return std::nullopt;
}

void set_length(std::span<std::byte> datagram, std::size_t offset, std::uint16_t length) noexcept {
  constexpr std::size_t kLengthAt = 8;  // in the header
  pdu::store_big_endian(datagram.data() + offset + kLengthAt, length);
}

}  // namespace reckon::tools
