// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Articulated Parts PDU (type 48): articulated and attached parts of a live entity, in the records
// of an Entity State.
#pragma once

#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/live_entity/live_entity.hpp"

namespace reckon::pdu {

struct ArticulatedParts {
  static constexpr PduType kPduType = PduType::articulated_parts;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;
  using VariableParameters = Records<VariableParameter, std::uint8_t>;

  PduHeader header = header_of<ArticulatedParts>();
  LiveEntityId live_entity_id;
  std::span<const std::byte> variable_parameters;  ///< 16 n octets
};

constexpr void fields(auto& visitor, Is<ArticulatedParts> auto& pdu) {
  visitor("header", pdu.header);
  visitor("live_entity_id", pdu.live_entity_id);
  visitor.count("number_of_variable_parameter_records", pdu.variable_parameters,
                ArticulatedParts::VariableParameters{});
  visitor.records("variable_parameters", pdu.variable_parameters,
                  ArticulatedParts::VariableParameters{});
}
static_assert(kFixedSize<ArticulatedParts> == 17);

}  // namespace reckon::pdu
