// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Point Object State PDU (type 43): an object of the terrain at one point.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/environment/object_state.hpp"
#include "reckon/pdu/environment/object_type.hpp"

namespace reckon::pdu {

struct PointObjectState {
  static constexpr PduType kPduType = PduType::point_object_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;

  PduHeader header = header_of<PointObjectState>();
  EntityId object_id;
  EntityId referenced_object_id;
  std::uint16_t update_number = 0;
  ForceId force_id = ForceId::other;
  std::uint8_t modifications = 0;
  ObjectType object_type;
  WorldCoordinates object_location;  ///< [m]
  EulerAngles object_orientation;    ///< [rad]
  std::uint32_t specific_object_appearance = 0;
  std::uint16_t general_object_appearance = 0;
  std::uint16_t padding_1 = 0;
  SimulationAddress requester_simulation_address;
  SimulationAddress receiving_simulation_address;
  std::uint32_t padding_2 = 0;
};

constexpr void fields(auto& visitor, Is<PointObjectState> auto& pdu) {
  object_head_fields(visitor, pdu);
  visitor("modifications", pdu.modifications);
  visitor("object_type", pdu.object_type);
  visitor("object_location", pdu.object_location);
  visitor("object_orientation", pdu.object_orientation);
  visitor("specific_object_appearance", pdu.specific_object_appearance);
  visitor("general_object_appearance", pdu.general_object_appearance);
  visitor("padding_1", pdu.padding_1);
  object_address_fields(visitor, pdu);
  visitor("padding_2", pdu.padding_2);
}
static_assert(kFixedSize<PointObjectState> == 88);

}  // namespace reckon::pdu
