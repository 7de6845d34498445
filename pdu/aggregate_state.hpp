// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Aggregate State PDU (type 33): a unit of many entities; silent systems and variable datums are
// kept as octets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/aggregate_type.hpp"
#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"
#include "pdu/records.hpp"

namespace reckon::pdu {

struct AggregateState {
  static constexpr PduType kPduType = PduType::aggregate_state;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::entity_management;
  using AggregateIds = Records<EntityId, std::uint16_t>;
  using EntityIds = Records<EntityId, std::uint16_t>;

  PduHeader header = header_of<AggregateState>();
  EntityId aggregate_id;
  ForceId force_id = ForceId::other;
  std::uint8_t aggregate_state = 0;
  AggregateType aggregate_type;
  std::uint32_t formation = 0;
  std::uint8_t aggregate_marking_character_set = 0;
  std::array<char, 31> aggregate_marking{};
  Vector3Float dimensions;                   ///< [m]
  EulerAngles orientation;                   ///< [rad]
  WorldCoordinates center_of_mass;           ///< [m]
  Vector3Float velocity;                     ///< [m/s]
  std::span<const std::byte> aggregate_ids;  ///< read with records_of<EntityId>
  std::span<const std::byte> entity_ids;     ///< read with records_of<EntityId>
  std::uint16_t number_of_silent_aggregate_systems = 0;
  std::uint16_t number_of_silent_entity_systems = 0;
  RestOfPdu silent_systems_and_variable_datums;
};

template <typename Visitor, Is<AggregateState> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("aggregate_id", pdu.aggregate_id);
  visitor("force_id", pdu.force_id);
  visitor("aggregate_state", pdu.aggregate_state);
  visitor("aggregate_type", pdu.aggregate_type);
  visitor("formation", pdu.formation);
  visitor("aggregate_marking_character_set", pdu.aggregate_marking_character_set);
  visitor("aggregate_marking", pdu.aggregate_marking);
  visitor("dimensions", pdu.dimensions);
  visitor("orientation", pdu.orientation);
  visitor("center_of_mass", pdu.center_of_mass);
  visitor("velocity", pdu.velocity);
  visitor.count("number_of_aggregates", pdu.aggregate_ids, AggregateState::AggregateIds{});
  visitor.count("number_of_entities", pdu.entity_ids, AggregateState::EntityIds{});
  visitor("number_of_silent_aggregate_systems", pdu.number_of_silent_aggregate_systems);
  visitor("number_of_silent_entity_systems", pdu.number_of_silent_entity_systems);
  visitor.records("aggregate_ids", pdu.aggregate_ids, AggregateState::AggregateIds{});
  visitor.records("entity_ids", pdu.entity_ids, AggregateState::EntityIds{});
  visitor.walked("silent_systems_and_variable_datums", pdu.silent_systems_and_variable_datums);
}
static_assert(kFixedSize<AggregateState> == 132);

}  // namespace reckon::pdu
