// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The messages of the protocol on the wire: the octets of Assured Records (PDU 150). Requests,
// grants and refusals are Transfer Ownership and Acknowledge PDUs inside them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/ownership/messages.hpp"

namespace reckon::peer {

/// What standard PDUs of a hand-over name.
struct TransferNames {
  std::uint8_t exercise = 1;
  pdu::SimulationAddress sender;
  pdu::SimulationAddress receiver;  ///< 65535:65535: all
  pdu::SimulationAddress scene;     ///< of the objects; object k is entity k + 1
};

struct EncodedMessage {
  pdu::AssuredKind kind = pdu::AssuredKind::record;
  bool is_pdu = false;  ///< the octets are one whole PDU
  std::size_t size = 0;
};

/// Writes a message, at most pdu::kMostAssured octets.
/// @param half of a round with many voters: its low bit selects which of them it names
[[nodiscard]] EncodedMessage encode_message(const OwnershipMessage& message,
                                            const TransferNames& names, std::uint32_t half,
                                            std::span<std::byte> out) noexcept;
/// Nothing for octets that no peer sends: of another kind, cut short, with numbers out of range, or
/// states that are not finite.
[[nodiscard]] std::optional<OwnershipMessage> decode_message(
    pdu::AssuredKind kind, std::span<const std::byte> octets) noexcept;

/// A round names at most this many voters; a larger roll takes two rounds in turn.
inline constexpr std::size_t kMostNamed = 24;

}  // namespace reckon::peer
