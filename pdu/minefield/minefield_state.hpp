// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Minefield State PDU (type 37): place and mine types of a minefield.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/minefield/minefield_records.hpp"

namespace reckon::pdu {

struct MinefieldState {
  static constexpr PduType kPduType = PduType::minefield_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::minefield;
  using PerimeterPoints = Records<Vector2Float, std::uint8_t>;
  using MineTypes = Records<EntityType, std::uint16_t>;

  PduHeader header = header_of<MinefieldState>();
  EntityId minefield_id;
  std::uint16_t minefield_sequence = 0;
  ForceId force_id = ForceId::other;
  std::span<const std::byte> perimeter_points;  ///< read with records_of<Vector2Float>
  EntityType minefield_type;
  std::span<const std::byte> mine_types;  ///< read with records_of<EntityType>
  WorldCoordinates minefield_location;    ///< [m]
  EulerAngles minefield_orientation;      ///< [rad]
  std::uint16_t appearance = 0;
  std::uint16_t protocol_mode = 0;
};

constexpr void fields(auto& visitor, Is<MinefieldState> auto& pdu) {
  visitor("header", pdu.header);
  visitor("minefield_id", pdu.minefield_id);
  visitor("minefield_sequence", pdu.minefield_sequence);
  visitor("force_id", pdu.force_id);
  visitor.count("number_of_perimeter_points", pdu.perimeter_points,
                MinefieldState::PerimeterPoints{});
  visitor("minefield_type", pdu.minefield_type);
  visitor.count("number_of_mine_types", pdu.mine_types, MinefieldState::MineTypes{});
  visitor("minefield_location", pdu.minefield_location);
  visitor("minefield_orientation", pdu.minefield_orientation);
  visitor("appearance", pdu.appearance);
  visitor("protocol_mode", pdu.protocol_mode);
  visitor.records("perimeter_points", pdu.perimeter_points, MinefieldState::PerimeterPoints{});
  visitor.records("mine_types", pdu.mine_types, MinefieldState::MineTypes{});
}
static_assert(kFixedSize<MinefieldState> == 72);

}  // namespace reckon::pdu
