// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Minefield Data PDU (type 39): single mines. The data selected by data_filter are kept as octets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/minefield/minefield_records.hpp"

namespace reckon::pdu {

struct MinefieldData {
  static constexpr PduType kPduType = PduType::minefield_data;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::minefield;
  using SensorTypes = Records<SensorType, std::uint8_t>;

  PduHeader header = header_of<MinefieldData>();
  EntityId minefield_id;
  EntityId requesting_entity_id;
  std::uint16_t minefield_sequence = 0;
  std::uint8_t request_id = 0;
  std::uint8_t pdu_sequence_number = 0;
  std::uint8_t number_of_pdus = 0;
  std::uint8_t number_of_mines = 0;
  std::span<const std::byte> sensor_types;  ///< read with records_of<SensorType>
  std::uint8_t padding = 0;
  std::uint32_t data_filter = 0;
  EntityType mine_type;
  RestOfPdu mines;
};

template <typename Visitor, Is<MinefieldData> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("minefield_id", pdu.minefield_id);
  visitor("requesting_entity_id", pdu.requesting_entity_id);
  visitor("minefield_sequence", pdu.minefield_sequence);
  visitor("request_id", pdu.request_id);
  visitor("pdu_sequence_number", pdu.pdu_sequence_number);
  visitor("number_of_pdus", pdu.number_of_pdus);
  visitor("number_of_mines", pdu.number_of_mines);
  visitor.count("number_of_sensor_types", pdu.sensor_types, MinefieldData::SensorTypes{});
  visitor("padding", pdu.padding);
  visitor("data_filter", pdu.data_filter);
  visitor("mine_type", pdu.mine_type);
  visitor.records("sensor_types", pdu.sensor_types, MinefieldData::SensorTypes{});
  visitor.walked("mines", pdu.mines);
}
static_assert(kFixedSize<MinefieldData> == 44);

}  // namespace reckon::pdu
