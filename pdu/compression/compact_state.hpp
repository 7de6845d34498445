// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The compact form of an Entity State: quantised, of variable length and complete by itself, so
// that the loss of one affects no other. About 60 octets instead of 144.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/compression/state_numbers.hpp"

namespace reckon::pdu {

/// Greatest number of octets of a body.
inline constexpr std::size_t kMostCompact = 160;

/// Writes all of `state` except its ID and exercise. Returns the octets written. Returns 0 if the
/// form cannot hold the state, which the caller must then send as a plain Entity State: it has
/// variable parameters, another protocol version or status than ours, numbers beyond StateNumbers,
/// or `out` has less room than kMostCompact. The function reads the written octets back and
/// compares them: the motion is within half a quantum, all else is exact. About 110 ns.
[[nodiscard]] std::size_t encode_compact(const EntityState& state, const StateScale& scale,
                                         std::span<std::byte> out) noexcept;

/// Reads a body into `state` and sets all its fields except ID and exercise. `timestamp` is the
/// timestamp of the PDU that contains the body, at most 1.5 s after the state's. Returns false,
/// without a change, if the octets are not a body. `body` may be any octets. About 60 ns.
[[nodiscard]] bool decode_compact(std::span<const std::byte> body, std::uint32_t timestamp,
                                  const StateScale& scale, EntityState& state) noexcept;

}  // namespace reckon::pdu
