// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Action Response-R PDU (type 57): Action Response with reliability.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct ActionResponseR {
  static constexpr PduType kPduType = PduType::action_response_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<ActionResponseR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;  ///< of the PDU that is answered
  std::uint32_t response_status = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

template <typename Visitor, Is<ActionResponseR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("response_status", pdu.response_status);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, ActionResponseR::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, ActionResponseR::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<ActionResponseR> == 40);

}  // namespace reckon::pdu
