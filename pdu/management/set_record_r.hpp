// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Set Record-R PDU (type 64): sets records in another simulation.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

struct SetRecordR {
  static constexpr PduType kPduType = PduType::set_record_r;
  static constexpr ProtocolFamily kProtocolFamily = management_family(kPduType);

  PduHeader header = header_of<SetRecordR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  ReliabilityService reliability;
  std::uint32_t padding_3 = 0;
  SizedRecords<RecordSet, std::uint32_t> record_sets;
};

constexpr void fields(auto& visitor, Is<SetRecordR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("request_id", pdu.request_id);
  fields(visitor, pdu.reliability);
  visitor("padding_3", pdu.padding_3);
  visitor("number_of_record_sets", pdu.record_sets.count);
  visitor.walked("record_sets", pdu.record_sets);
}
static_assert(kFixedSize<SetRecordR> == 40);

}  // namespace reckon::pdu
