// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Acknowledge-R PDU (type 55): the answer to a PDU of the reliability family.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct AcknowledgeR {
  static constexpr PduType kPduType = PduType::acknowledge_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;

  PduHeader header = header_of<AcknowledgeR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  AcknowledgeFlag acknowledge_flag = AcknowledgeFlag::create_entity;
  ResponseFlag response_flag = ResponseFlag::other;
  std::uint32_t request_id = 0;  ///< of the PDU that is answered
};

template <typename Visitor, Is<AcknowledgeR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("acknowledge_flag", pdu.acknowledge_flag);
  visitor("response_flag", pdu.response_flag);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<AcknowledgeR> == 32);

}  // namespace reckon::pdu
