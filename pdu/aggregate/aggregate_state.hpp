// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Aggregate State PDU (type 33): a unit of many entities; silent systems and variable datums are
// kept as octets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/pdu/aggregate/aggregate_type.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/management/datum.hpp"

namespace reckon::pdu {

/// Aggregates that do not send their own states.
struct SilentAggregateSystem {
  std::uint16_t number_of_aggregates = 0;
  std::uint16_t padding = 0;
  AggregateType aggregate_type;
};
static_assert(kFixedSize<SilentAggregateSystem> == 12);

/// Appearance of an entity that does not send its own state.
struct SilentAppearance {
  std::uint32_t entity_appearance = 0;
};

/// Head of a group of entities that do not send their own states; their appearances follow.
struct SilentEntitySystem {
  std::uint16_t number_of_entities = 0;
  std::uint16_t number_of_appearance_records = 0;
  EntityType entity_type;

  [[nodiscard]] WalkResult extent(std::span<const std::byte>) const noexcept {
    return {number_of_appearance_records * kFixedSize<SilentAppearance>, DecodeError::none};
  }
};
static_assert(kFixedSize<SilentEntitySystem> == 12);

void parts(auto& visitor, const SilentEntitySystem&, std::span<const std::byte> body) {
  visitor.records("appearance_records", body, Records<SilentAppearance, std::uint16_t>{});
}

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
  /// Padding, both lists of silent systems and the variable datums. They are shown by fields if
  /// they fit. Among the recorded products, one states a wrong length of its datums, another a
  /// wrong length of the whole PDU.
  RestOfPdu silent_systems_and_variable_datums;
};

/// Content of AggregateState::silent_systems_and_variable_datums.
struct SilentSystems {
  std::span<const std::byte> padding;  ///< up to a multiple of 4 octets
  std::span<const std::byte> aggregates;
  SizedRecords<SilentEntitySystem, std::uint16_t> entities;
  VariableDatums datums;
  bool datums_fit = false;            ///< else they and their number are in `behind`
  std::span<const std::byte> behind;  ///< else empty, except in PDUs of a later revision

  /// False if the octets do not hold the systems that the PDU states.
  [[nodiscard]] bool take(const AggregateState& pdu) noexcept;
};

inline bool SilentSystems::take(const AggregateState& pdu) noexcept {
  std::span<const std::byte> rest = pdu.silent_systems_and_variable_datums.bytes;
  const auto cut = [&rest](std::size_t size) {
    const auto part = rest.first(size);
    rest = rest.subspan(size);
    return part;
  };
  const std::size_t ids = pdu.aggregate_ids.size() + pdu.entity_ids.size();
  const std::size_t gap = padded_to(ids, 4) - ids;
  const std::size_t fixed =
      pdu.number_of_silent_aggregate_systems * kFixedSize<SilentAggregateSystem>;
  if (rest.size() < gap + fixed) return false;
  padding = cut(gap);
  aggregates = cut(fixed);

  entities.count = pdu.number_of_silent_entity_systems;
  const WalkResult walked = entities.walk(entities.count, rest);
  if (walked.error != DecodeError::none) return false;
  entities.bytes = cut(walked.size);
  behind = rest;
  if (rest.size() < sizeof datums.count) return true;
  datums.count = load_big_endian<std::uint32_t>(cut(sizeof datums.count).data());
  const WalkResult last = VariableDatums::walk(datums.count, rest);
  if (last.error != DecodeError::none) return true;
  datums_fit = true;
  datums.bytes = cut(last.size);
  behind = rest;
  return true;
}

/// Shows the silent systems by their fields. False, with nothing done, if they do not fit.
bool show_silent_systems(auto& visitor, const AggregateState& pdu) {
  SilentSystems silent;
  if (!silent.take(pdu)) return false;
  visitor.walked("padding_to_32_bits", RestOfPdu{silent.padding});
  visitor.records("silent_aggregate_systems", silent.aggregates,
                  Records<SilentAggregateSystem, std::uint16_t>{});
  visitor.walked("silent_entity_systems", silent.entities);
  if (silent.datums_fit) {
    visitor("number_of_variable_datum_records", silent.datums.count);
    visitor.walked("variable_datum_records", silent.datums);
  }
  if (!silent.behind.empty()) visitor.walked("further_octets", RestOfPdu{silent.behind});
  return true;
}

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
  if constexpr (Looks<Visitor, Pdu>) {
    if (show_silent_systems(visitor, pdu)) return;
  }
  visitor.walked("silent_systems_and_variable_datums", pdu.silent_systems_and_variable_datums);
}
static_assert(kFixedSize<AggregateState> == 132);

}  // namespace reckon::pdu
