// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a federate sends an interaction, and which assured ones did not arrive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/peer/reliable/undelivered.hpp"

namespace reckon::peer {

/// Effort that is made for an interaction.
enum class Delivery : std::uint8_t {
  best_effort,  ///< sent once; the network may lose it
  assured,      ///< repeated until each joined peer has acknowledged it, for 5 s at most
};

/// Order in which peers take assured interactions.
enum class Order : std::uint8_t {
  none,  ///< as they arrive
  /// Peers take the interactions of one sender with this order in the order of sending. A lost
  /// interaction delays the later ones until its repeat arrives or it fails, after 5 s at most.
  /// Other interactions do not wait.
  per_source,
};

/// An assured interaction that was sent; number 0: one by best effort.
struct MessageHandle {
  std::uint64_t number = 0;
  friend constexpr bool operator==(const MessageHandle&, const MessageHandle&) = default;
};

/// A peer that did not get an interaction.
struct MissedPeer {
  aoim::PeerId peer;
  UndeliveredCause cause = UndeliveredCause::gave_up;
};

/// An assured interaction that some peers did not get.
struct UndeliveredMessage {
  MessageHandle message;
  pdu::PduType type = pdu::PduType::other;
  std::vector<MissedPeer> peers;
};

/// The tag of a message in the model loop: its number, and its type in the lower 8 bits.
[[nodiscard]] std::uint64_t message_tag(MessageHandle message, pdu::PduType type) noexcept;

/// @throws std::logic_error in an interop scene and for a type that cannot be assured (Entity
/// State, Attribute, experimental), std::length_error for a PDU that is too long
void check_assured(pdu::PduType type, std::size_t octets, bool interop);

/// @throws std::logic_error for an order of an interaction by best effort
void check_order(Delivery delivery, Order order);

/// Calls back once for each message, with the peers that follow each other in `undelivered`.
void report_undelivered(std::span<const Undelivered> undelivered,
                        const std::function<void(const UndeliveredMessage&)>& callback);

}  // namespace reckon::peer
