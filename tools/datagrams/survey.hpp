// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Looks ahead in a datagram, for rules about related PDUs.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/attribute.hpp"

namespace reckon::tools {

/// Exercise and entity in one number.
[[nodiscard]] constexpr std::uint64_t entity_key(std::uint8_t exercise, pdu::EntityId id) noexcept {
  return std::uint64_t{exercise} << 48 | id.key();
}

/// PDUs later in a datagram, found before its PDUs are checked.
struct DatagramSurvey {
  struct Place {
    std::uint64_t entity = 0;  ///< entity_key
    std::size_t pdu = 0;       ///< number of the PDU, from 1
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  std::vector<Place> attributes;  ///< sorted: the record sets of its Attribute PDUs

  /// Fills the lists from the octets; unreadable parts are left out.
  void look_at(std::span<const std::byte> datagram) {
    attributes.clear();
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      if (bundled.error != pdu::DecodeError::none) continue;
      pdu::Attribute attribute;
      if (bundled.header.pdu_type != pdu::PduType::attribute ||
          decode(bundled.bytes, attribute) != pdu::DecodeError::none)
        continue;
      for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute))
        attributes.push_back(
            {entity_key(bundled.header.exercise_id, set.entity_id), bundled.index + 1});
    }
    std::sort(attributes.begin(), attributes.end());
  }
  /// The places of one entity.
  [[nodiscard]] std::span<const Place> of(std::uint64_t entity) const {
    const auto less = [](const Place& place, std::uint64_t key) { return place.entity < key; };
    const auto first = std::lower_bound(attributes.begin(), attributes.end(), entity, less);
    const auto last = std::lower_bound(first, attributes.end(), entity + 1, less);
    return {first, last};
  }
};

}  // namespace reckon::tools
