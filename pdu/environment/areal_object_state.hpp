// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Areal Object State PDU (type 45): an object of the terrain that covers a polygon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/environment/object_state.hpp"
#include "reckon/pdu/environment/object_type.hpp"

namespace reckon::pdu {

struct ArealObjectState {
  static constexpr PduType kPduType = PduType::areal_object_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;
  using Points = Records<WorldCoordinates, std::uint16_t>;

  PduHeader header = header_of<ArealObjectState>();
  EntityId object_id;
  EntityId referenced_object_id;
  std::uint16_t update_number = 0;
  ForceId force_id = ForceId::other;
  std::uint8_t modifications = 0;
  ObjectType object_type;
  std::uint32_t specific_object_appearance = 0;
  std::uint16_t general_object_appearance = 0;
  std::span<const std::byte> points;  ///< read with records_of<WorldCoordinates>
  SimulationAddress requester_simulation_address;
  SimulationAddress receiving_simulation_address;
};

constexpr void fields(auto& visitor, Is<ArealObjectState> auto& pdu) {
  object_head_fields(visitor, pdu);
  visitor("modifications", pdu.modifications);
  visitor("object_type", pdu.object_type);
  visitor("specific_object_appearance", pdu.specific_object_appearance);
  visitor("general_object_appearance", pdu.general_object_appearance);
  visitor.count("number_of_points", pdu.points, ArealObjectState::Points{});
  object_address_fields(visitor, pdu);
  visitor.records("points", pdu.points, ArealObjectState::Points{});
}
static_assert(kFixedSize<ArealObjectState> == 48);

}  // namespace reckon::pdu
