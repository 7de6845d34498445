// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transfer Ownership PDU (type 35): transfers the simulation of an entity to another application.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"

namespace reckon::pdu {

struct TransferOwnership {
  static constexpr PduType kPduType = PduType::transfer_ownership;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_management;

  PduHeader header = header_of<TransferOwnership>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t transfer_type = 0;
  EntityId transfer_entity_id;
  SizedRecords<RecordSet, std::uint32_t> record_sets;
};

constexpr void fields(auto& visitor, Is<TransferOwnership> auto& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("transfer_type", pdu.transfer_type);
  visitor("transfer_entity_id", pdu.transfer_entity_id);
  visitor("number_of_record_sets", pdu.record_sets.count);
  visitor.walked("record_sets", pdu.record_sets);
}
static_assert(kFixedSize<TransferOwnership> == 40);

}  // namespace reckon::pdu
