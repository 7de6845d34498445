// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Linear Object State PDU (type 44): a wall, a trench, a tape: segments in a row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/object_type.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

/// One straight piece of a linear object.
struct LinearSegment {
  std::uint8_t segment_number = 0;
  std::uint8_t segment_modification = 0;
  std::uint16_t general_segment_appearance = 0;
  std::uint32_t specific_segment_appearance = 0;
  WorldCoordinates segment_location;  ///< [m]
  EulerAngles segment_orientation;    ///< [rad]
  float segment_length = 0.0F;        ///< [m]
  float segment_width = 0.0F;         ///< [m]
  float segment_height = 0.0F;        ///< [m]
  float segment_depth = 0.0F;         ///< [m]
  std::uint32_t padding = 0;
};

template <typename Visitor, Is<LinearSegment> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("segment_number", record.segment_number);
  visitor("segment_modification", record.segment_modification);
  visitor("general_segment_appearance", record.general_segment_appearance);
  visitor("specific_segment_appearance", record.specific_segment_appearance);
  visitor("segment_location", record.segment_location);
  visitor("segment_orientation", record.segment_orientation);
  visitor("segment_length", record.segment_length);
  visitor("segment_width", record.segment_width);
  visitor("segment_height", record.segment_height);
  visitor("segment_depth", record.segment_depth);
  visitor("padding", record.padding);
}
static_assert(kFixedSize<LinearSegment> == 64);

struct LinearObjectState {
  static constexpr PduType kPduType = PduType::linear_object_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;
  using LinearSegments = Records<LinearSegment, std::uint8_t>;

  PduHeader header = header_of<LinearObjectState>();
  EntityId object_id;
  EntityId referenced_object_id;
  std::uint16_t update_number = 0;
  ForceId force_id = ForceId::other;
  std::span<const std::byte> linear_segments;  ///< read with records_of<LinearSegment>
  SimulationAddress requester_simulation_address;
  SimulationAddress receiving_simulation_address;
  ObjectType object_type;
};

template <typename Visitor, Is<LinearObjectState> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("object_id", pdu.object_id);
  visitor("referenced_object_id", pdu.referenced_object_id);
  visitor("update_number", pdu.update_number);
  visitor("force_id", pdu.force_id);
  visitor.count("number_of_linear_segments", pdu.linear_segments,
                LinearObjectState::LinearSegments{});
  visitor("requester_simulation_address", pdu.requester_simulation_address);
  visitor("receiving_simulation_address", pdu.receiving_simulation_address);
  visitor("object_type", pdu.object_type);
  visitor.records("linear_segments", pdu.linear_segments, LinearObjectState::LinearSegments{});
}
static_assert(kFixedSize<LinearObjectState> == 40);

}  // namespace reckon::pdu
