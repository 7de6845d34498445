// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Action Response PDU (type 17): what became of an action request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct ActionResponse {
  static constexpr PduType kPduType = PduType::action_response;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<ActionResponse>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;  ///< of the PDU that is answered
  std::uint32_t request_status = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

template <typename Visitor, Is<ActionResponse> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("request_status", pdu.request_status);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, ActionResponse::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, ActionResponse::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<ActionResponse> == 40);

}  // namespace reckon::pdu
