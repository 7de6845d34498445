// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The compact form of an Entity State: quantised, of variable length and complete by itself, so
// that a loss has no further effect. About 60 octets of 144.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/compression/state_numbers.hpp"

namespace reckon::pdu {

/// Greatest number of octets of a body.
inline constexpr std::size_t kMostCompact = 160;

/// Writes all of `state` except its ID and exercise. Returns the octets written. Returns 0 if the
/// form cannot hold the state, which then has to be sent plain: variable parameters, another
/// protocol version or status than ours, numbers beyond StateNumbers, less room than kMostCompact.
/// The written octets are first read back and compared: the motion is within half a quantum, all
/// else is exact. About 110 ns.
[[nodiscard]] std::size_t encode_compact(const EntityState& state, const StateScale& scale,
                                         std::span<std::byte> out) noexcept;

/// Reads a body into `state`, of which it sets all except ID and exercise. `timestamp` is that of
/// the PDU around it, at most 1.5 s after the state's. Returns false, without a change, if the
/// octets are not a body. Any octets. About 60 ns.
[[nodiscard]] bool decode_compact(std::span<const std::byte> body, std::uint32_t timestamp,
                                  const StateScale& scale, EntityState& state) noexcept;

}  // namespace reckon::pdu
