// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Minefield Query PDU (type 38): requests the mines in a region.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/minefield/minefield_records.hpp"

namespace reckon::pdu {

struct MinefieldQuery {
  static constexpr PduType kPduType = PduType::minefield_query;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::minefield;
  using RequestedPerimeterPoints = Records<Vector2Float, std::uint8_t>;
  using SensorTypes = Records<SensorType, std::uint8_t>;

  PduHeader header = header_of<MinefieldQuery>();
  EntityId minefield_id;
  EntityId requesting_entity_id;
  std::uint8_t request_id = 0;
  std::span<const std::byte> requested_perimeter_points;  ///< read with records_of<Vector2Float>
  std::uint8_t padding = 0;
  std::span<const std::byte> sensor_types;  ///< read with records_of<SensorType>
  std::uint32_t data_filter = 0;
  EntityType requested_mine_type;
  RestOfPdu padding_to_32_bits;
};

constexpr void fields(auto& visitor, Is<MinefieldQuery> auto& pdu) {
  visitor("header", pdu.header);
  visitor("minefield_id", pdu.minefield_id);
  visitor("requesting_entity_id", pdu.requesting_entity_id);
  visitor("request_id", pdu.request_id);
  visitor.count("number_of_perimeter_points", pdu.requested_perimeter_points,
                MinefieldQuery::RequestedPerimeterPoints{});
  visitor("padding", pdu.padding);
  visitor.count("number_of_sensor_types", pdu.sensor_types, MinefieldQuery::SensorTypes{});
  visitor("data_filter", pdu.data_filter);
  visitor("requested_mine_type", pdu.requested_mine_type);
  visitor.records("requested_perimeter_points", pdu.requested_perimeter_points,
                  MinefieldQuery::RequestedPerimeterPoints{});
  visitor.records("sensor_types", pdu.sensor_types, MinefieldQuery::SensorTypes{});
  visitor.walked("padding_to_32_bits", pdu.padding_to_32_bits);
}
static_assert(kFixedSize<MinefieldQuery> == 40);

}  // namespace reckon::pdu
