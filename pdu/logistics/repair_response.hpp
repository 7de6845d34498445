// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Repair Response PDU (type 10): the answer to Repair Complete.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct RepairResponse {
  static constexpr PduType kPduType = PduType::repair_response;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::logistics;

  PduHeader header = header_of<RepairResponse>();
  EntityId receiving_entity_id;
  EntityId repairing_entity_id;
  std::uint8_t repair_result = 0;
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
};
static_assert(kFixedSize<RepairResponse> == 28);

}  // namespace reckon::pdu
