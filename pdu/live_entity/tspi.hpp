// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// TSPI PDU (type 46): time, space and position of a live entity. The bits of its flag octet, from
// the lowest: linear velocity, orientation, position error, orientation error, dead reckoning
// parameters, measured speed, system-specific data.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/live_entity/live_entity.hpp"

namespace reckon::pdu {

struct LivePositionError {
  std::uint16_t horizontal_error = 0;
  std::uint16_t vertical_error = 0;
};

struct LiveOrientationError {
  std::uint16_t azimuth_error = 0;
  std::uint16_t elevation_error = 0;
  std::uint16_t rotation_error = 0;
};

struct LiveDeadReckoningParameters {
  DeadReckoningAlgorithm algorithm = DeadReckoningAlgorithm::static_;
  LiveVector<std::int8_t> linear_acceleration;
  LiveVector<std::int8_t> angular_velocity;
};

constexpr void fields(auto& visitor, Is<LiveDeadReckoningParameters> auto& record) {
  visitor("dead_reckoning_algorithm", record.algorithm);
  visitor("entity_linear_acceleration", record.linear_acceleration);
  visitor("entity_angular_velocity", record.angular_velocity);
}

struct Tspi {
  static constexpr PduType kPduType = PduType::tspi;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::live_entity;

  PduHeader header = header_of<Tspi>();
  LiveEntityId live_entity_id;
  std::uint8_t flags = 0;
  RelativeWorldCoordinates entity_location;
  LiveVector<std::int16_t> entity_linear_velocity;  ///< bit 0 [dm/s]
  LiveEulerAngles<std::int8_t> entity_orientation;  ///< bit 1
  LivePositionError position_error;                 ///< bit 2
  LiveOrientationError orientation_error;           ///< bit 3
  LiveDeadReckoningParameters dead_reckoning;       ///< bit 4
  std::uint16_t measured_speed = 0;                 ///< bit 5 [dm/s]
  OctetBlock<std::uint8_t> system_specific_data;    ///< bit 6
};

constexpr void fields(auto& visitor, Is<Tspi> auto& pdu) {
  visitor("header", pdu.header);
  visitor("live_entity_id", pdu.live_entity_id);
  visitor("tspi_flags", pdu.flags);
  visitor("entity_location", pdu.entity_location);
  when(has_flag(pdu.flags, 0), visitor, "entity_linear_velocity", pdu.entity_linear_velocity);
  when(has_flag(pdu.flags, 1), visitor, "entity_orientation", pdu.entity_orientation);
  when(has_flag(pdu.flags, 2), visitor, "position_error", pdu.position_error);
  when(has_flag(pdu.flags, 3), visitor, "orientation_error", pdu.orientation_error);
  when(has_flag(pdu.flags, 4), visitor, "dead_reckoning_parameters", pdu.dead_reckoning);
  when(has_flag(pdu.flags, 5), visitor, "measured_speed", pdu.measured_speed);
  when(has_flag(pdu.flags, 6), visitor, "system_specific_data_length",
       pdu.system_specific_data.count);
  walked_when(has_flag(pdu.flags, 6), visitor, "system_specific_data", pdu.system_specific_data);
}
static_assert(kFixedSize<Tspi> == 25);

}  // namespace reckon::pdu
