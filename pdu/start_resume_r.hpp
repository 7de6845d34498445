// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Start/Resume-R PDU (type 53): Start/Resume with reliability.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct StartResumeR {
  static constexpr PduType kPduType = PduType::start_resume_r;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::simulation_management_with_reliability;

  PduHeader header = header_of<StartResumeR>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ClockTime real_world_time;
  ClockTime simulation_time;
  std::uint8_t required_reliability_service = 0;  ///< 0 acknowledged, 1 unacknowledged
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  std::uint32_t request_id = 0;
};

template <typename Visitor, Is<StartResumeR> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("real_world_time", pdu.real_world_time);
  visitor("simulation_time", pdu.simulation_time);
  visitor("required_reliability_service", pdu.required_reliability_service);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<StartResumeR> == 48);

}  // namespace reckon::pdu
