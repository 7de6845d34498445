// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Information Operations Action PDU (type 70): an attack on, or the defence of, information.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"

namespace reckon::pdu {

struct InformationOperationsAction {
  static constexpr PduType kPduType = PduType::information_operations_action;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::information_operations;

  PduHeader header = header_of<InformationOperationsAction>();
  EntityId originating_simulation_id;
  EntityId receiving_simulation_id;
  std::uint32_t request_id = 0;
  std::uint16_t io_warfare_type = 0;
  std::uint16_t io_simulation_source = 0;
  std::uint16_t io_action_type = 0;
  std::uint16_t io_action_phase = 0;
  std::uint32_t padding_1 = 0;
  EntityId io_attacker_entity_id;
  EntityId io_primary_target_entity_id;
  std::uint16_t padding_2 = 0;
  SizedRecords<StandardVariableRecord, std::uint16_t> io_records;
};

constexpr void fields(auto& visitor, Is<InformationOperationsAction> auto& pdu) {
  visitor("header", pdu.header);
  visitor("originating_simulation_id", pdu.originating_simulation_id);
  visitor("receiving_simulation_id", pdu.receiving_simulation_id);
  visitor("request_id", pdu.request_id);
  visitor("io_warfare_type", pdu.io_warfare_type);
  visitor("io_simulation_source", pdu.io_simulation_source);
  visitor("io_action_type", pdu.io_action_type);
  visitor("io_action_phase", pdu.io_action_phase);
  visitor("padding_1", pdu.padding_1);
  visitor("io_attacker_entity_id", pdu.io_attacker_entity_id);
  visitor("io_primary_target_entity_id", pdu.io_primary_target_entity_id);
  visitor("padding_2", pdu.padding_2);
  visitor("number_of_io_records", pdu.io_records.count);
  visitor.walked("io_records", pdu.io_records);
}
static_assert(kFixedSize<InformationOperationsAction> == 56);

}  // namespace reckon::pdu
