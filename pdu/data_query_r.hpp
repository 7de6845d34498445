// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data Query-R PDU (type 58): Data Query with reliability.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct DataQueryR {
  static constexpr PduType kPduType = PduType::data_query_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;
  using FixedDatumIds = Records<DatumId, std::uint32_t>;
  using VariableDatumIds = Records<DatumId, std::uint32_t>;

  PduHeader header = header_of<DataQueryR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  std::uint32_t request_id = 0;
  std::uint32_t time_interval = 0;                ///< between answers, in timestamp units; 0 = once
  std::span<const std::byte> fixed_datum_ids;     ///< read with records_of<DatumId>
  std::span<const std::byte> variable_datum_ids;  ///< read with records_of<DatumId>
};

template <typename Visitor, Is<DataQueryR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("request_id", pdu.request_id);
  visitor("time_interval", pdu.time_interval);
  visitor.count("number_of_fixed_datum_ids", pdu.fixed_datum_ids, DataQueryR::FixedDatumIds{});
  visitor.count("number_of_variable_datum_ids", pdu.variable_datum_ids,
                DataQueryR::VariableDatumIds{});
  visitor.records("fixed_datum_ids", pdu.fixed_datum_ids, DataQueryR::FixedDatumIds{});
  visitor.records("variable_datum_ids", pdu.variable_datum_ids, DataQueryR::VariableDatumIds{});
}
static_assert(kFixedSize<DataQueryR> == 44);

}  // namespace reckon::pdu
