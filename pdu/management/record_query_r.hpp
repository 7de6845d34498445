// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Record Query-R PDU (type 65): requests records by their IDs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/datum.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

struct RecordQueryR {
  static constexpr PduType kPduType = PduType::record_query_r;
  static constexpr ProtocolFamily kProtocolFamily = management_family(kPduType);

  PduHeader header = header_of<RecordQueryR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  ShortReliabilityService reliability;
  std::uint16_t event_type = 0;
  std::uint32_t time = 0;                 ///< between answers, in timestamp units
  std::span<const std::byte> record_ids;  ///< read with records_of<DatumId>
};

constexpr void fields(auto& visitor, Is<RecordQueryR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("request_id", pdu.request_id);
  fields(visitor, pdu.reliability);
  visitor("event_type", pdu.event_type);
  visitor("time", pdu.time);
  visitor.count("number_of_record_ids", pdu.record_ids, DatumIds{});
  visitor.records("record_ids", pdu.record_ids, DatumIds{});
}
static_assert(kFixedSize<RecordQueryR> == 40);

}  // namespace reckon::pdu
