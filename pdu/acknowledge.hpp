// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Acknowledge PDU (type 15, IEEE 1278.1-2012 7.5.6): the answer to create, remove, start and stop.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct Acknowledge {
  static constexpr PduType kPduType = PduType::acknowledge;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;

  PduHeader header = header_of<Acknowledge>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  AcknowledgeFlag acknowledge_flag = AcknowledgeFlag::create_entity;
  ResponseFlag response_flag = ResponseFlag::other;
  std::uint32_t request_id = 0;  ///< of the PDU that is answered
};

template <typename Visitor, Is<Acknowledge> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("acknowledge_flag", pdu.acknowledge_flag);
  visitor("response_flag", pdu.response_flag);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<Acknowledge> == 32);

}  // namespace reckon::pdu
