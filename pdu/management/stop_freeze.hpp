// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Stop/Freeze (type 14, IEEE 1278.1-2012 7.5.5) and Stop/Freeze-R (54): an entity or the exercise
// stops at a stated time.
#pragma once

#include <cstdint>
#include <type_traits>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Bits of frozen_behavior (SISO UID 68).
inline constexpr std::uint8_t kFrozenRunInternalClock = 0x01;
inline constexpr std::uint8_t kFrozenTransmitUpdates = 0x02;
inline constexpr std::uint8_t kFrozenProcessUpdates = 0x04;

/// Two octets where the reliable version has its service.
struct ShortPadding {
  std::uint16_t padding = 0;
};

/// Stops at `real_world_time`.
template <PduType type>
struct BasicStopFreeze {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicStopFreeze>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ClockTime real_world_time;  ///< UTC of the stop
  StopFreezeReason reason = StopFreezeReason::other;
  std::uint8_t frozen_behavior = 0;
  std::conditional_t<is_reliable(type), ShortReliabilityService, ShortPadding> reliability;
  std::uint32_t request_id = 0;
};

using StopFreeze = BasicStopFreeze<PduType::stop_freeze>;
using StopFreezeR = BasicStopFreeze<PduType::stop_freeze_r>;

constexpr void fields(auto& visitor, IsOneOf<StopFreeze, StopFreezeR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("real_world_time", pdu.real_world_time);
  visitor("reason", pdu.reason);
  visitor("frozen_behavior", pdu.frozen_behavior);
  fields(visitor, pdu.reliability);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<StopFreeze> == 40);
static_assert(kFixedSize<StopFreezeR> == 40);

}  // namespace reckon::pdu
