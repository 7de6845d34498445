// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/envelope.hpp"

#include <cassert>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::peer {

using pdu::store_big_endian;

void write_envelope(const EnvelopeHeader& header,
                    std::span<std::byte, kEnvelopeHeader> out) noexcept {
  assert(header.count <= kEnvelopeCountMask);
  std::byte* at = out.data();
  const std::uint64_t front = std::uint64_t{kSealedOctet} << 56 |
                              std::uint64_t{static_cast<std::uint8_t>(header.suite)} << 48 |
                              std::uint64_t{header.epoch} << 32 |
                              std::uint64_t{header.sealer.site} << 16 | header.sealer.application;
  store_big_endian(at, front);
  store_big_endian(at + 8, header.sealer.boot);
  store_big_endian(at + 16, std::uint64_t{header.stream} << kEnvelopeCountBits | header.count);
  store_big_endian(at + 24, header.stamp);
  store_big_endian(at + 28, header.salt);
}

}  // namespace reckon::peer
