// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/envelope.hpp"

#include <cassert>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::peer {
namespace {

using pdu::load_big_endian;
using pdu::store_big_endian;

constexpr int kCountBits = 48;
constexpr std::uint64_t kCountMask = (std::uint64_t{1} << kCountBits) - 1;

}  // namespace

std::optional<EnvelopeHeader> read_envelope(std::span<const std::byte> datagram) noexcept {
  if (!is_sealed(datagram)) return std::nullopt;
  const std::byte* at = datagram.data();
  EnvelopeHeader header;
  header.suite = static_cast<SealingSuite>(at[1]);
  if (header.suite != SealingSuite::aes_256_gcm && header.suite != SealingSuite::xchacha20_poly1305)
    return std::nullopt;
  header.epoch = load_big_endian<std::uint16_t>(at + 2);
  header.sealer.site = load_big_endian<std::uint16_t>(at + 4);
  header.sealer.application = load_big_endian<std::uint16_t>(at + 6);
  header.sealer.boot = load_big_endian<std::uint64_t>(at + 8);
  const auto sequence = load_big_endian<std::uint64_t>(at + 16);
  header.stream = static_cast<std::uint16_t>(sequence >> kCountBits);
  header.count = sequence & kCountMask;
  return header;
}

void write_envelope(const EnvelopeHeader& header,
                    std::span<std::byte, kEnvelopeHeader> out) noexcept {
  assert(header.count <= kCountMask);
  std::byte* at = out.data();
  at[0] = std::byte{kSealedOctet};
  at[1] = static_cast<std::byte>(header.suite);
  store_big_endian(at + 2, header.epoch);
  store_big_endian(at + 4, header.sealer.site);
  store_big_endian(at + 6, header.sealer.application);
  store_big_endian(at + 8, header.sealer.boot);
  store_big_endian(at + 16, std::uint64_t{header.stream} << kCountBits | header.count);
}

}  // namespace reckon::peer
