// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// IsPartOf PDU (type 36): joins an entity to another as its part.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct IsPartOf {
  static constexpr PduType kPduType = PduType::is_part_of;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_management;

  PduHeader header = header_of<IsPartOf>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint16_t relationship_nature = 0;
  std::uint16_t relationship_position = 0;
  Vector3Float part_location;  ///< its centroid, in axes of the receiving entity
  std::uint16_t station_name = 0;
  std::uint16_t station_number = 0;
  EntityType part_entity_type;
};
static_assert(kFixedSize<IsPartOf> == 52);

}  // namespace reckon::pdu
