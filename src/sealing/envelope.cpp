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
  at[0] = std::byte{kSealedOctet};
  at[1] = static_cast<std::byte>(header.suite);
  store_big_endian(at + 2, header.epoch);
  store_big_endian(at + 4, header.sealer.site);
  store_big_endian(at + 6, header.sealer.application);
  store_big_endian(at + 8, header.sealer.boot);
  store_big_endian(at + 16, std::uint64_t{header.stream} << kEnvelopeCountBits | header.count);
  store_big_endian(at + 24, header.stamp);
  store_big_endian(at + 28, header.salt);
}

}  // namespace reckon::peer
