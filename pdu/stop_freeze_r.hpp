// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stop/Freeze-R PDU (type 54): Stop/Freeze with reliability.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct StopFreezeR {
  static constexpr PduType kPduType = PduType::stop_freeze_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;

  PduHeader header = header_of<StopFreezeR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ClockTime real_world_time;
  StopFreezeReason reason = StopFreezeReason::other;
  std::uint8_t frozen_behavior = 0;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding = 0;
  std::uint32_t request_id = 0;
};

template <typename Visitor, Is<StopFreezeR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("real_world_time", pdu.real_world_time);
  visitor("reason", pdu.reason);
  visitor("frozen_behavior", pdu.frozen_behavior);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("padding", pdu.padding);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<StopFreezeR> == 40);

}  // namespace reckon::pdu
