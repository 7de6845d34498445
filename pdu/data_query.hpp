// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data Query PDU (type 18): asks for data by their ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct DataQuery {
  static constexpr PduType kPduType = PduType::data_query;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;
  using FixedDatumIds = Records<DatumId, std::uint32_t>;
  using VariableDatumIds = Records<DatumId, std::uint32_t>;

  PduHeader header = header_of<DataQuery>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  std::uint32_t time_interval = 0;                ///< between answers, in timestamp units; 0 = once
  std::span<const std::byte> fixed_datum_ids;     ///< read with records_of<DatumId>
  std::span<const std::byte> variable_datum_ids;  ///< read with records_of<DatumId>
};

template <typename Visitor, Is<DataQuery> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("time_interval", pdu.time_interval);
  visitor.count("number_of_fixed_datum_ids", pdu.fixed_datum_ids, DataQuery::FixedDatumIds{});
  visitor.count("number_of_variable_datum_ids", pdu.variable_datum_ids,
                DataQuery::VariableDatumIds{});
  visitor.records("fixed_datum_ids", pdu.fixed_datum_ids, DataQuery::FixedDatumIds{});
  visitor.records("variable_datum_ids", pdu.variable_datum_ids, DataQuery::VariableDatumIds{});
}
static_assert(kFixedSize<DataQuery> == 40);

}  // namespace reckon::pdu
