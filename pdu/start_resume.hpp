// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Start/Resume PDU (type 13, IEEE 1278.1-2012 7.5.4): an entity or the exercise starts at a stated
// time.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct StartResume {
  static constexpr PduType kPduType = PduType::start_resume;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::simulation_management;

  PduHeader header = header_of<StartResume>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ClockTime real_world_time;  ///< UTC at which to start
  ClockTime simulation_time;  ///< simulation time at that instant
  std::uint32_t request_id = 0;
};

template <typename Visitor, Is<StartResume> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("originating_entity_id", pdu.originating_entity_id);
  visitor("receiving_entity_id", pdu.receiving_entity_id);
  visitor("real_world_time", pdu.real_world_time);
  visitor("simulation_time", pdu.simulation_time);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<StartResume> == 44);

}  // namespace reckon::pdu
