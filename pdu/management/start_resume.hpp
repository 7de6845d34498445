// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Start/Resume (type 13, IEEE 1278.1-2012 7.5.4) and Start/Resume-R (53): an entity or the exercise
// starts at a stated time.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/management/simulation_management.hpp"

namespace reckon::pdu {

/// Starts at `real_world_time`, which is `simulation_time` in the exercise.
template <PduType type>
struct BasicStartResume {
  static constexpr PduType kPduType = type;
  static constexpr ProtocolFamily kProtocolFamily = management_family(type);

  PduHeader header = header_of<BasicStartResume>();
  EntityId originating_entity_id;
  EntityId receiving_entity_id;
  ClockTime real_world_time;  ///< UTC of the start
  ClockTime simulation_time;  ///< simulation time at that instant
  ServiceOf<type> reliability;
  std::uint32_t request_id = 0;
};

using StartResume = BasicStartResume<PduType::start_resume>;
using StartResumeR = BasicStartResume<PduType::start_resume_r>;

constexpr void fields(auto& visitor, IsOneOf<StartResume, StartResumeR> auto& pdu) {
  management_fields(visitor, pdu);
  visitor("real_world_time", pdu.real_world_time);
  visitor("simulation_time", pdu.simulation_time);
  fields(visitor, pdu.reliability);
  visitor("request_id", pdu.request_id);
}
static_assert(kFixedSize<StartResume> == 44);
static_assert(kFixedSize<StartResumeR> == 48);

}  // namespace reckon::pdu
