// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Refuses datagrams that cannot belong to this exercise. The reader refuses them at once, which
// costs less than queueing them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/peer/sealing/envelope.hpp"

namespace reckon::peer {

/// Reason to refuse a datagram.
enum class Refusal : std::uint8_t {
  none,
  version,    ///< its first octet is not a supported DIS version
  length,     ///< it, or the length in its PDU header, is shorter than a PDU header
  exercise,   ///< its first PDU belongs to another exercise
  sealed,     ///< it is sealed, and the link has no key
  no_length,  ///< the length field of its first PDU is 0
};
inline constexpr std::size_t kRefusals = 6;

/// Checks the first PDU header of a datagram. Later stages apply all other rules. Some ns, no
/// allocation.
[[nodiscard]] inline Refusal refuse_at_gate(std::span<const std::byte> datagram,
                                            std::uint8_t exercise) noexcept {
  const auto octet = [&](std::size_t at) { return std::to_integer<unsigned>(datagram[at]); };
  if (datagram.empty()) return Refusal::length;
  if (is_sealed(datagram)) return Refusal::sealed;
  if (!pdu::is_supported_version(static_cast<std::uint8_t>(octet(0)))) return Refusal::version;
  if (datagram.size() < pdu::kHeaderSize) return Refusal::length;
  if (octet(1) != exercise) return Refusal::exercise;
  const unsigned length = octet(8) << 8 | octet(9);
  if (length == 0) return Refusal::no_length;
  if (length < pdu::kHeaderSize) return Refusal::length;
  return Refusal::none;
}

}  // namespace reckon::peer
