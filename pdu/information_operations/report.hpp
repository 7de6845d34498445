// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Information Operations Report PDU (type 71): the effect of an information operation.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"

namespace reckon::pdu {

struct InformationOperationsReport {
  static constexpr PduType kPduType = PduType::information_operations_report;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::information_operations;

  PduHeader header = header_of<InformationOperationsReport>();
  EntityId originating_simulation_id;
  std::uint16_t io_simulation_source = 0;
  std::uint8_t io_report_type = 0;
  std::uint8_t padding_1 = 0;
  EntityId io_attacker_entity_id;
  EntityId io_primary_target_entity_id;
  std::uint16_t padding_2 = 0;
  std::uint16_t padding_3 = 0;
  SizedRecords<StandardVariableRecord, std::uint16_t> io_records;
};

constexpr void fields(auto& visitor, Is<InformationOperationsReport> auto& pdu) {
  visitor("header", pdu.header);
  visitor("originating_simulation_id", pdu.originating_simulation_id);
  visitor("io_simulation_source", pdu.io_simulation_source);
  visitor("io_report_type", pdu.io_report_type);
  visitor("padding_1", pdu.padding_1);
  visitor("io_attacker_entity_id", pdu.io_attacker_entity_id);
  visitor("io_primary_target_entity_id", pdu.io_primary_target_entity_id);
  visitor("padding_2", pdu.padding_2);
  visitor("padding_3", pdu.padding_3);
  visitor("number_of_io_records", pdu.io_records.count);
  visitor.walked("io_records", pdu.io_records);
}
static_assert(kFixedSize<InformationOperationsReport> == 40);

}  // namespace reckon::pdu
