// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The octets of a PDU that differ from those of an earlier one of the same entity, its key,
// whatever they mean: what a compression that knows no fields comes to, for comparison with the
// forms of the product. Exact. A receiver without the key cannot read it and knows that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::bench {

/// Octets of a PDU that can be a key, or have one.
inline constexpr std::size_t kMostDelta = 208;

/// What names a key: 16 bits of its octets. Some 20 ns.
[[nodiscard]] std::uint16_t key_check(std::span<const std::byte> key) noexcept;

/// Writes a body: the key's check (u16), a bit for each 8 octets of the PDU, a bit for each octet
/// of those that differ, and the octets that differ. Octets written; 0 where the sizes differ, are
/// above kMostDelta, or the body would not be shorter than the PDU or has no room.
/// @param check of `key`
[[nodiscard]] std::size_t encode_delta(std::span<const std::byte> key, std::uint16_t check,
                                       std::span<const std::byte> pdu,
                                       std::span<std::byte> out) noexcept;

/// The key's check that a body begins with; 0 of a body too short.
[[nodiscard]] std::uint16_t key_of_delta(std::span<const std::byte> body) noexcept;

/// Restores the PDU into `out`, which is as long as `key`. False, with `out` in part set, where the
/// octets are no body for a key of this length. Any octets may come.
[[nodiscard]] bool decode_delta(std::span<const std::byte> key, std::span<const std::byte> body,
                                std::span<std::byte> out) noexcept;

}  // namespace reckon::bench
