// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The issuer of a PDU other than an Entity State: an entity or a simulation.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// The IDs in whose name a PDU may be sent. If a simulation issues it, the entity is 0.
class InteractionIssuers {
 public:
  static constexpr std::size_t kMost = 2;
  void add(const pdu::EntityId& id) noexcept { ids_[count_++] = id; }
  [[nodiscard]] std::span<const pdu::EntityId> ids() const noexcept {
    return {ids_.data(), count_};
  }

 private:
  std::array<pdu::EntityId, kMost> ids_{};
  std::size_t count_ = 0;
};

/// For nearly all types, the first ID behind the header. For answers and requests to the owner of
/// the first ID, the second (Resupply Offer, Repair Complete, Minefield Query and Response NACK).
/// Both if either may send it (Resupply Cancel, and states of point, linear and areal objects,
/// which a requester of a change may also send). None for types without a field table and for PDUs
/// that are too short. Accepts any octets. Some ns, no allocation.
[[nodiscard]] InteractionIssuers issuers_of(const pdu::PduHeader& header,
                                            std::span<const std::byte> pdu) noexcept;

}  // namespace reckon::peer
