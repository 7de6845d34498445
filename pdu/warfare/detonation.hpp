// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Detonation PDU (type 3): a munition explodes, hits or fails.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/warfare/munition_descriptor.hpp"

namespace reckon::pdu {

struct Detonation {
  static constexpr PduType kPduType = PduType::detonation;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::warfare;
  using VariableParameters = Records<VariableParameter, std::uint8_t>;

  PduHeader header = header_of<Detonation>();
  EntityId source_entity_id;
  EntityId target_entity_id;
  EntityId exploding_entity_id;
  EventId event_id;
  Vector3Float velocity;                           ///< before the detonation, world axes [m/s]
  WorldCoordinates location_in_world_coordinates;  ///< [m]
  MunitionDescriptor descriptor;
  Vector3Float location_in_entity_coordinates;  ///< body axes of the target [m]
  std::uint8_t detonation_result = 0;
  std::span<const std::byte> variable_parameters;  ///< read with records_of<VariableParameter>
  std::uint16_t padding = 0;
};

constexpr void fields(auto& visitor, Is<Detonation> auto& pdu) {
  visitor("header", pdu.header);
  visitor("source_entity_id", pdu.source_entity_id);
  visitor("target_entity_id", pdu.target_entity_id);
  visitor("exploding_entity_id", pdu.exploding_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("velocity", pdu.velocity);
  visitor("location_in_world_coordinates", pdu.location_in_world_coordinates);
  descriptor_field(visitor, pdu);
  visitor("location_in_entity_coordinates", pdu.location_in_entity_coordinates);
  visitor("detonation_result", pdu.detonation_result);
  visitor.count("number_of_variable_parameter_records", pdu.variable_parameters,
                Detonation::VariableParameters{});
  visitor("padding", pdu.padding);
  visitor.records("variable_parameters", pdu.variable_parameters, Detonation::VariableParameters{});
}
static_assert(kFixedSize<Detonation> == 104);

}  // namespace reckon::pdu
