// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Looks ahead in a datagram, for rules about related PDUs.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::tools {

/// PDUs later in a datagram, found before its PDUs are checked.
struct DatagramSurvey {
  struct Place {
    std::uint64_t entity = 0;  ///< entity_key
    std::size_t pdu = 0;       ///< number of the PDU, from 1
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::vector<Place> attributes;  ///< sorted: the record sets of its Attribute PDUs

  /// Fills the lists from the octets; unreadable parts are left out.
  void look_at(std::span<const std::byte> datagram);
  /// The places of one entity.
  [[nodiscard]] std::span<const Place> of(std::uint64_t entity) const;
};

/// Exercise and entity in one number.
[[nodiscard]] constexpr std::uint64_t entity_key(std::uint8_t exercise, pdu::EntityId id) noexcept {
  return std::uint64_t{exercise} << 48 | id.key();
}

}  // namespace reckon::tools
