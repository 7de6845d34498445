// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Set Record-R PDU (type 64): sets records in another simulation.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"
#include "pdu/standard_variable_record.hpp"

namespace reckon::pdu {

struct SetRecordR {
  static constexpr PduType kPduType = PduType::set_record_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;

  PduHeader header = header_of<SetRecordR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  std::uint32_t padding_3 = 0;
  SizedRecords<RecordSet, std::uint32_t> record_sets;
};

template <typename Visitor, Is<SetRecordR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("padding_3", pdu.padding_3);
  visitor("number_of_record_sets", pdu.record_sets.count);
  visitor.walked("record_sets", pdu.record_sets);
}
static_assert(kFixedSize<SetRecordR> == 40);

}  // namespace reckon::pdu
