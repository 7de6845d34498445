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
#include "reckon/pdu/reckon/datagram_trailer.hpp"

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
  /// Owner of a body of the scene.
  struct Owner {
    std::uint64_t entity = 0;  ///< entity_key
    pdu::OwnershipRecord record;
  };
  std::vector<Place> attributes;  ///< sorted: the record sets of its Attribute PDUs
  std::vector<Owner> owners;
  std::uint32_t epoch = 0;  ///< of its sender; 0 without a trailer

  /// Fills the lists from the octets; unreadable parts are left out.
  void look_at(std::span<const std::byte> datagram) {
    attributes.clear();
    owners.clear();
    epoch = 0;
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      if (bundled.error != pdu::DecodeError::none) continue;
      pdu::DatagramTrailer trailer;
      if (bundled.header.pdu_type == pdu::PduType::datagram_trailer &&
          decode(bundled.bytes, trailer) == pdu::DecodeError::none)
        epoch = trailer.epoch;
      pdu::Attribute attribute;
      if (bundled.header.pdu_type != pdu::PduType::attribute ||
          decode(bundled.bytes, attribute) != pdu::DecodeError::none)
        continue;
      for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) look_at(set, bundled);
    }
    std::sort(attributes.begin(), attributes.end());
  }
  /// Null if the datagram names no owner of this entity.
  [[nodiscard]] const pdu::OwnershipRecord* owner_of(std::uint64_t entity) const {
    const auto found = std::ranges::find(owners, entity, &Owner::entity);
    return found == owners.end() ? nullptr : &found->record;
  }
  /// The places of one entity.
  [[nodiscard]] std::span<const Place> of(std::uint64_t entity) const {
    const auto less = [](const Place& place, std::uint64_t key) { return place.entity < key; };
    const auto first = std::lower_bound(attributes.begin(), attributes.end(), entity, less);
    const auto last = std::lower_bound(first, attributes.end(), entity + 1, less);
    return {first, last};
  }

 private:
  void look_at(const pdu::AttributeSet& set, const pdu::BundledPdu& bundled) {
    const std::uint64_t key = entity_key(bundled.header.exercise_id, set.entity_id);
    attributes.push_back({key, bundled.index + 1});
    for (const pdu::AttributeRecord& record : set.records()) {
      pdu::OwnershipRecord owner;
      if (decode(record, owner) == pdu::DecodeError::none) owners.push_back({key, owner});
    }
  }
};

}  // namespace reckon::tools
