// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// In whose name a PDU is said that is no Entity State: the entity or simulation that issues it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "reckon/pdu/codec/pdu_header.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::peer {

/// The IDs that a PDU may be said in the name of. Of one issued by a simulation the entity is 0.
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

/// Of nearly all types the first ID behind the header; of those that answer or ask the owner of
/// the first, the second (Resupply Offer, Repair Complete, Minefield Query and Response NACK); of
/// those that either may say, both (Resupply Cancel, states of point, linear and areal objects,
/// which who wants them changed may send). None of types that have no field table, and of PDUs too
/// short. Any octets may come. Some ns, no allocation.
[[nodiscard]] InteractionIssuers issuers_of(const pdu::PduHeader& header,
                                            std::span<const std::byte> pdu) noexcept;

}  // namespace reckon::peer
