// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Event Report-R PDU (type 61): Event Report with reliability.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct EventReportR {
  static constexpr PduType kPduType = PduType::event_report_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;
  using FixedDatums = Records<FixedDatum, std::uint32_t>;

  PduHeader header = header_of<EventReportR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t event_type = 0;
  std::uint32_t padding = 0;
  std::span<const std::byte> fixed_datums;  ///< 8 n octets, read with records_of<FixedDatum>
  VariableDatums variable_datums;
};

template <typename Visitor, Is<EventReportR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("event_type", pdu.event_type);
  visitor("padding", pdu.padding);
  visitor.count("number_of_fixed_datum_records", pdu.fixed_datums, EventReportR::FixedDatums{});
  visitor("number_of_variable_datum_records", pdu.variable_datums.count);
  visitor.records("fixed_datum_records", pdu.fixed_datums, EventReportR::FixedDatums{});
  visitor.walked("variable_datum_records", pdu.variable_datums);
}
static_assert(kFixedSize<EventReportR> == 40);

}  // namespace reckon::pdu
