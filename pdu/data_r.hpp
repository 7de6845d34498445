// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data-R PDU (type 60): Data with reliability; sources differ in its layout behind the ids, so it
// is kept as octets.
#pragma once

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct DataR {
  static constexpr PduType kPduType = PduType::data_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;

  PduHeader header = header_of<DataR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  RestOfPdu body;
};

template <typename Visitor, Is<DataR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor.walked("body", pdu.body);
}
static_assert(kFixedSize<DataR> == 24);

}  // namespace reckon::pdu
