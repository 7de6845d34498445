// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Fire PDU (type 2): a weapon is fired.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/warfare/munition_descriptor.hpp"

namespace reckon::pdu {

struct Fire {
  static constexpr PduType kPduType = PduType::fire;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::warfare;

  PduHeader header = header_of<Fire>();
  EntityId firing_entity_id;
  EntityId target_entity_id;
  EntityId munition_expendable_id;
  EventId event_id;
  std::uint32_t fire_mission_index = 0;
  WorldCoordinates location_in_world_coordinates;  ///< of the launch [m]
  MunitionDescriptor descriptor;
  Vector3Float velocity;  ///< of the munition, world axes [m/s]
  float range = 0.0F;     ///< assumed by the firing entity; 0 = unknown [m]
};

constexpr void fields(auto& visitor, Is<Fire> auto& pdu) {
  visitor("header", pdu.header);
  visitor("firing_entity_id", pdu.firing_entity_id);
  visitor("target_entity_id", pdu.target_entity_id);
  visitor("munition_expendable_id", pdu.munition_expendable_id);
  visitor("event_id", pdu.event_id);
  visitor("fire_mission_index", pdu.fire_mission_index);
  visitor("location_in_world_coordinates", pdu.location_in_world_coordinates);
  descriptor_field(visitor, pdu);
  visitor("velocity", pdu.velocity);
  visitor("range", pdu.range);
}
static_assert(kFixedSize<Fire> == 96);

}  // namespace reckon::pdu
