// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data Query (type 18) and Data Query-R (58): requests data of another simulation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Requests data by their IDs.
template <PduType type>
struct BasicDataQuery {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicDataQuery>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ServiceOf<type> reliability;
  std::uint32_t request_id = 0;
  std::uint32_t time_interval = 0;                ///< between answers, in timestamp units; 0 = once
  std::span<const std::byte> fixed_datum_ids;     ///< read with records_of<DatumId>
  std::span<const std::byte> variable_datum_ids;  ///< read with records_of<DatumId>
};

using DataQuery = BasicDataQuery<PduType::data_query>;
using DataQueryR = BasicDataQuery<PduType::data_query_r>;

constexpr void fields(auto& visitor, IsOneOf<DataQuery, DataQueryR> auto& pdu) {
  management_fields(visitor, pdu);
  fields(visitor, pdu.reliability);
  visitor("request_id", pdu.request_id);
  visitor("time_interval", pdu.time_interval);
  visitor.count("number_of_fixed_datum_ids", pdu.fixed_datum_ids, DatumIds{});
  visitor.count("number_of_variable_datum_ids", pdu.variable_datum_ids, DatumIds{});
  visitor.records("fixed_datum_ids", pdu.fixed_datum_ids, DatumIds{});
  visitor.records("variable_datum_ids", pdu.variable_datum_ids, DatumIds{});
}
static_assert(kFixedSize<DataQuery> == 40);
static_assert(kFixedSize<DataQueryR> == 44);

}  // namespace reckon::pdu
