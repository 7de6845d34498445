// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The compact form of an Entity State: quantised, of variable length, complete by itself, so that
// loss costs nothing beyond what was lost. About 60 octets of 144.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/compression/state_numbers.hpp"

namespace reckon::pdu {

/// Octets that any body fits into.
inline constexpr std::size_t kMostCompact = 160;

/// Writes all of `state` but its id and exercise. Octets written; 0 where the form cannot carry it,
/// so that it has to go as it is: variable parameters, another protocol version or status than
/// ours, numbers beyond StateNumbers, less room than kMostCompact. What was written is read back
/// and compared first: the motion is within half a quantum, all else is exact. About 110 ns.
[[nodiscard]] std::size_t encode_compact(const EntityState& state, const StateScale& scale,
                                         std::span<std::byte> out) noexcept;

/// Reads a body into `state`, of which it sets all but id and exercise. `timestamp` of the PDU
/// around it, at most 1.5 s after the state's. False, and nothing changes, where the octets are no
/// body. Any octets may come. About 60 ns.
[[nodiscard]] bool decode_compact(std::span<const std::byte> body, std::uint32_t timestamp,
                                  const StateScale& scale, EntityState& state) noexcept;

}  // namespace reckon::pdu
