// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/wire_mutator.hpp"

#include <algorithm>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::fuzz {

void repair_header(std::span<std::byte> octets) noexcept {
  if (octets.size() < pdu::kHeaderSize) return;
  if (!pdu::is_supported_version(std::to_integer<std::uint8_t>(octets[0])))
    octets[0] = std::byte{pdu::kProtocolVersion};
  const std::size_t length = std::min<std::size_t>(octets.size(), pdu::kMaxPduSize);
  pdu::store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(length));
}

void repair_last_length(std::span<std::byte> datagram) noexcept {
  std::size_t last = 0;
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram)) last = pdu.offset;
  repair_header(datagram.subspan(last));
}

}  // namespace reckon::fuzz
