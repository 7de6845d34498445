// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Resupply Cancel PDU (type 8): cancels a resupply.
#pragma once

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct ResupplyCancel {
  static constexpr PduType kPduType = PduType::resupply_cancel;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::logistics;

  PduHeader header = header_of<ResupplyCancel>();
  EntityId receiving_entity_id;
  EntityId supplying_entity_id;
};
static_assert(kFixedSize<ResupplyCancel> == 24);

}  // namespace reckon::pdu
