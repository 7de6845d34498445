// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// IsGroupOf PDU (type 34): entities that one simulation shows as a group.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/pdu/aggregate/grouped_entities.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct IsGroupOf {
  static constexpr PduType kPduType = PduType::is_group_of;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_management;

  PduHeader header = header_of<IsGroupOf>();
  EntityId group_entity_id;
  std::uint8_t grouped_entity_category = 0;  ///< the kind of all descriptions, from 1 to 9
  std::uint8_t number_of_grouped_entities = 0;
  std::uint32_t padding = 0;
  double latitude = 0.0;
  double longitude = 0.0;
  RestOfPdu grouped_entity_descriptions;  ///< shown by fields if they fill it exactly
};

/// Shows the descriptions as records of their category. False, with nothing done, if the category
/// is unknown or its records do not fill the octets exactly.
bool show_grouped_entities(auto& visitor, const IsGroupOf& pdu) {
  const std::size_t count = pdu.number_of_grouped_entities;
  const auto octets = pdu.grouped_entity_descriptions.bytes;
  const auto as = [&]<typename Record>(Record) {
    if (count == 0 || octets.size() != count * kFixedSize<Record>) return false;
    visitor.records("grouped_entity_descriptions", octets, Records<Record, std::uint8_t>{});
    return true;
  };
  switch (pdu.grouped_entity_category) {
    case 1:
      return as(GroupedVehicle{});
    case 2:
      return as(GroupedVehicleStores{});
    case 3:
      return as(GroupedSoldier{});
    case 4:
      return as(GroupedSoldierStores{});
    case 5:
      return as(GroupedHelicopter{});
    case 6:
      return as(GroupedHelicopterStores{});
    case 7:
      return as(GroupedAircraft{});
    case 8:
      return as(GroupedAircraftStores{});
    case 9:
      return as(GroupedLogistics{});
    default:
      return false;
  }
}

template <typename Visitor, Is<IsGroupOf> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("group_entity_id", pdu.group_entity_id);
  visitor("grouped_entity_category", pdu.grouped_entity_category);
  visitor("number_of_grouped_entities", pdu.number_of_grouped_entities);
  visitor("padding", pdu.padding);
  visitor("latitude", pdu.latitude);
  visitor("longitude", pdu.longitude);
  if constexpr (Looks<Visitor, Pdu>) {
    if (show_grouped_entities(visitor, pdu)) return;
  }
  visitor.walked("grouped_entity_descriptions", pdu.grouped_entity_descriptions);
}
static_assert(kFixedSize<IsGroupOf> == 40);

}  // namespace reckon::pdu
