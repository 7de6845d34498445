// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Set Data-R PDU (type 59): Set Data with reliability.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct SetDataR {
  static constexpr PduType kPduType = PduType::set_data_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<SetDataR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  std::uint32_t request_id = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

template <typename Visitor, Is<SetDataR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("request_id", pdu.request_id);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, SetDataR::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, SetDataR::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<SetDataR> == 40);

}  // namespace reckon::pdu
