// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Repair Complete PDU (type 9): a repair is done.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

struct RepairComplete {
  static constexpr PduType kPduType = PduType::repair_complete;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::logistics;

  PduHeader header = header_of<RepairComplete>();
  EntityId receiving_entity_id;
  EntityId repairing_entity_id;
  std::uint16_t repair = 0;
  std::uint16_t padding = 0;
};
static_assert(kFixedSize<RepairComplete> == 28);

}  // namespace reckon::pdu
