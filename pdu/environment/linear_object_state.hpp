// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Linear Object State PDU (type 44): a wall, a trench or a tape, as a row of segments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/environment/object_state.hpp"
#include "reckon/pdu/environment/object_type.hpp"

namespace reckon::pdu {

/// One straight segment of a linear object; its dimensions are numbers of type `Size`.
template <typename SizeType>
struct BasicLinearSegment {
  using Size = SizeType;
  std::uint8_t segment_number = 0;
  std::uint8_t segment_modification = 0;
  std::uint16_t general_segment_appearance = 0;
  std::uint32_t specific_segment_appearance = 0;
  WorldCoordinates segment_location;  ///< [m]
  EulerAngles segment_orientation;    ///< [rad]
  Size segment_length = 0;            ///< [m]
  Size segment_width = 0;             ///< [m]
  Size segment_height = 0;            ///< [m]
  Size segment_depth = 0;             ///< [m]
  std::uint32_t padding = 0;
};

using LinearSegment = BasicLinearSegment<float>;
using LinearSegmentOfDis6 = BasicLinearSegment<std::uint16_t>;

constexpr void fields(auto& visitor, IsOneOf<LinearSegment, LinearSegmentOfDis6> auto& record) {
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
static_assert(kFixedSize<LinearSegmentOfDis6> == 56);

struct LinearObjectState {
  static constexpr PduType kPduType = PduType::linear_object_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;
  using LinearSegments = Records<LinearSegment, std::uint8_t>;
  using LinearSegmentsOfDis6 = Records<LinearSegmentOfDis6, std::uint8_t>;

  PduHeader header = header_of<LinearObjectState>();
  EntityId object_id;
  EntityId referenced_object_id;
  std::uint16_t update_number = 0;
  ForceId force_id = ForceId::other;
  /// Read with records_of<LinearSegment>, up to DIS 6 with records_of<LinearSegmentOfDis6>.
  std::span<const std::byte> linear_segments;
  SimulationAddress requester_simulation_address;
  SimulationAddress receiving_simulation_address;
  ObjectType object_type;
};

constexpr void fields(auto& visitor, Is<LinearObjectState> auto& pdu) {
  object_head_fields(visitor, pdu);
  const bool dis6 = is_before_dis7(pdu.header);
  dis6 ? visitor.count("number_of_linear_segments", pdu.linear_segments,
                       LinearObjectState::LinearSegmentsOfDis6{})
       : visitor.count("number_of_linear_segments", pdu.linear_segments,
                       LinearObjectState::LinearSegments{});
  object_address_fields(visitor, pdu);
  visitor("object_type", pdu.object_type);
  dis6 ? visitor.records("linear_segments", pdu.linear_segments,
                         LinearObjectState::LinearSegmentsOfDis6{})
       : visitor.records("linear_segments", pdu.linear_segments,
                         LinearObjectState::LinearSegments{});
}
static_assert(kFixedSize<LinearObjectState> == 40);

}  // namespace reckon::pdu
