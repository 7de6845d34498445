// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entity State Update PDU (type 67): the fields of an Entity State that change often.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"

namespace reckon::pdu {

struct EntityStateUpdate {
  static constexpr PduType kPduType = PduType::entity_state_update;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_information_interaction;
  using VariableParameters = Records<VariableParameter, std::uint8_t>;

  PduHeader header = header_of<EntityStateUpdate>();
  EntityId entity_id;
  std::uint8_t padding = 0;
  std::span<const std::byte> variable_parameters;  ///< read with records_of<VariableParameter>
  Vector3Float entity_linear_velocity;             ///< axes as in the last Entity State [m/s]
  WorldCoordinates entity_location;                ///< [m]
  EulerAngles entity_orientation;                  ///< [rad]
  std::uint32_t entity_appearance = 0;
};

constexpr void fields(auto& visitor, Is<EntityStateUpdate> auto& pdu) {
  visitor("header", pdu.header);
  visitor("entity_id", pdu.entity_id);
  visitor("padding", pdu.padding);
  visitor.count("number_of_variable_parameter_records", pdu.variable_parameters,
                EntityStateUpdate::VariableParameters{});
  visitor("entity_linear_velocity", pdu.entity_linear_velocity);
  visitor("entity_location", pdu.entity_location);
  visitor("entity_orientation", pdu.entity_orientation);
  visitor("entity_appearance", pdu.entity_appearance);
  visitor.records("variable_parameters", pdu.variable_parameters,
                  EntityStateUpdate::VariableParameters{});
}
static_assert(kFixedSize<EntityStateUpdate> == 72);

}  // namespace reckon::pdu
