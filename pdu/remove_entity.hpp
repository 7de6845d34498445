// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Remove Entity PDU (type 12, IEEE 1278.1-2012 7.5): a simulation manager asks the receiver to
// remove an entity.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct RemoveEntity {
  static constexpr PduType kPduType = PduType::remove_entity;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;

  PduHeader header = header_of<RemoveEntity>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  std::uint32_t request_id = 0;  ///< the Acknowledge repeats it
};

template <typename Visitor, Is<RemoveEntity> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<RemoveEntity> == 28);

}  // namespace reckon::pdu
