// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gridded Data PDU (type 42): values on a grid; axes and values are kept as octets.
#pragma once

#include <cstdint>

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct GriddedData {
  static constexpr PduType kPduType = PduType::gridded_data;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::synthetic_environment;

  PduHeader header = header_of<GriddedData>();
  EntityId environmental_simulation_application_id;
  std::uint16_t field_number = 0;
  std::uint16_t pdu_number = 0;
  std::uint16_t pdu_total = 0;
  std::uint16_t coordinate_system = 0;
  std::uint8_t number_of_grid_axes = 0;
  std::uint8_t constant_grid = 0;
  EntityType environment_type;
  EulerAngles orientation;  ///< [rad]
  ClockTime sample_time;
  std::uint32_t total_values = 0;
  std::uint8_t vector_dimension = 0;
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  RestOfPdu grid_axes_and_data;
};

template <typename Visitor, Is<GriddedData> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("environmental_simulation_application_id", pdu.environmental_simulation_application_id);
  visitor("field_number", pdu.field_number);
  visitor("pdu_number", pdu.pdu_number);
  visitor("pdu_total", pdu.pdu_total);
  visitor("coordinate_system", pdu.coordinate_system);
  visitor("number_of_grid_axes", pdu.number_of_grid_axes);
  visitor("constant_grid", pdu.constant_grid);
  visitor("environment_type", pdu.environment_type);
  visitor("orientation", pdu.orientation);
  visitor("sample_time", pdu.sample_time);
  visitor("total_values", pdu.total_values);
  visitor("vector_dimension", pdu.vector_dimension);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  visitor.walked("grid_axes_and_data", pdu.grid_axes_and_data);
}
static_assert(kFixedSize<GriddedData> == 64);

}  // namespace reckon::pdu
