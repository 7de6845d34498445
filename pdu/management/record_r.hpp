// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Record-R PDU (type 63): record sets in answer to a query, or without one.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

struct RecordR {
  static constexpr PduType kPduType = PduType::record_r;
  static constexpr ProtocolFamily kProtocolFamily = management_family(kPduType);

  PduHeader header = header_of<RecordR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  ShortReliabilityService reliability;
  std::uint16_t event_type = 0;
  std::uint32_t response_serial_number = 0;
  SizedRecords<RecordSet, std::uint32_t> record_sets;
};

constexpr void fields(auto& visitor, Is<RecordR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("request_id", pdu.request_id);
  fields(visitor, pdu.reliability);
  visitor("event_type", pdu.event_type);
  visitor("response_serial_number", pdu.response_serial_number);
  visitor("number_of_record_sets", pdu.record_sets.count);
  visitor.walked("record_sets", pdu.record_sets);
}
static_assert(kFixedSize<RecordR> == 40);

}  // namespace reckon::pdu
