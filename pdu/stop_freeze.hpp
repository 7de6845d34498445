// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stop/Freeze PDU (type 14, IEEE 1278.1-2012 7.5.5): an entity or the exercise stops at a stated
// time.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

/// Bits of frozen_behavior (SISO UID 68).
inline constexpr std::uint8_t kFrozenRunInternalClock = 0x01;
inline constexpr std::uint8_t kFrozenTransmitUpdates = 0x02;
inline constexpr std::uint8_t kFrozenProcessUpdates = 0x04;

struct StopFreeze {
  static constexpr PduType kPduType = PduType::stop_freeze;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;

  PduHeader header = header_of<StopFreeze>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ClockTime real_world_time;  ///< UTC at which to stop
  StopFreezeReason reason = StopFreezeReason::other;
  std::uint8_t frozen_behavior = 0;
  std::uint16_t padding = 0;
  std::uint32_t request_id = 0;
};

template <typename Visitor, Is<StopFreeze> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("real_world_time", pdu.real_world_time);
  visitor("reason", pdu.reason);
  visitor("frozen_behavior", pdu.frozen_behavior);
  visitor("padding", pdu.padding);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<StopFreeze> == 40);

}  // namespace reckon::pdu
