// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Record Query-R PDU (type 65): asks for records by their ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/datum.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct RecordQueryR {
  static constexpr PduType kPduType = PduType::record_query_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;
  using RecordIds = Records<DatumId, std::uint32_t>;

  PduHeader header = header_of<RecordQueryR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding = 0;
  std::uint16_t event_type = 0;
  std::uint32_t time = 0;                 ///< between answers, in timestamp units
  std::span<const std::byte> record_ids;  ///< read with records_of<DatumId>
};

template <typename Visitor, Is<RecordQueryR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("padding", pdu.padding);
  visitor("event_type", pdu.event_type);
  visitor("time", pdu.time);
  visitor.count("number_of_record_ids", pdu.record_ids, RecordQueryR::RecordIds{});
  visitor.records("record_ids", pdu.record_ids, RecordQueryR::RecordIds{});
}
static_assert(kFixedSize<RecordQueryR> == 40);

}  // namespace reckon::pdu
