// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lossless compression of a PDU as its differences from an earlier PDU of the same entity, its key,
// octet by octet and without knowledge of fields; for comparison with the compressed forms of the
// product. A check of 16 bits identifies the key.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::bench {

/// Greatest size of a PDU that can be a key or can have one [octets].
inline constexpr std::size_t kMostDelta = 208;

/// Identifier of a key: 16 bits of its octets. About 20 ns.
[[nodiscard]] std::uint16_t key_check(std::span<const std::byte> key) noexcept;

/// Writes a body: the key's check (u16), a bit for each 8 octets of the PDU, a bit for each octet
/// of the groups that differ, and the octets that differ. Returns the octets written; 0 if the
/// sizes differ, are above kMostDelta, or the body would not be shorter than the PDU or has no
/// room.
/// @param check of `key`
[[nodiscard]] std::size_t encode_delta(std::span<const std::byte> key, std::uint16_t check,
                                       std::span<const std::byte> pdu,
                                       std::span<std::byte> out) noexcept;

/// The key's check at the start of a body; 0 if the body is too short.
[[nodiscard]] std::uint16_t key_of_delta(std::span<const std::byte> body) noexcept;

/// Restores the PDU into `out`, which is as long as `key`. Returns false, with `out` partly
/// written, if the octets are not a body for a key of this length. Any octets are safe.
[[nodiscard]] bool decode_delta(std::span<const std::byte> key, std::span<const std::byte> body,
                                std::span<std::byte> out) noexcept;

}  // namespace reckon::bench
