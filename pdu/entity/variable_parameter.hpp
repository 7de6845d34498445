// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Variable parameter records of an Entity State PDU (IEEE 1278.1-2012 6.2.94): 16 octets each, the
// first of which is the kind. Unknown kinds stay octets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// Any kind; the kinds below name the fields of `body`.
struct VariableParameter {
  VariableParameterType record_type = VariableParameterType::articulated_part;
  std::array<std::byte, 15> body{};
};

struct ArticulatedPart {
  static constexpr VariableParameterType kType = VariableParameterType::articulated_part;
  VariableParameterType record_type = kType;
  std::uint8_t change_indicator = 0;
  std::uint16_t part_attached_to = 0;
  std::uint32_t parameter_type = 0;  ///< part class (multiple of 32) + metric
  float parameter_value = 0.0F;      ///< unit according to the metric
  std::uint32_t padding = 0;
};

struct AttachedPart {
  static constexpr VariableParameterType kType = VariableParameterType::attached_part;
  VariableParameterType record_type = kType;
  std::uint8_t detached_indicator = 0;
  std::uint16_t part_attached_to = 0;
  std::uint32_t parameter_type = 0;
  EntityType attached_part_type;
};

struct Separation {
  static constexpr VariableParameterType kType = VariableParameterType::separation;
  VariableParameterType record_type = kType;
  std::uint8_t reason_for_separation = 0;
  std::uint8_t pre_entity_indicator = 0;
  std::uint8_t padding_1 = 0;
  EntityId parent_entity_id;
  std::uint16_t padding_2 = 0;
  std::uint16_t station_name = 0;
  std::uint16_t station_number = 0;
};

struct EntityTypeParameter {
  static constexpr VariableParameterType kType = VariableParameterType::entity_type;
  VariableParameterType record_type = kType;
  std::uint8_t change_indicator = 0;
  EntityType entity_type;
  std::uint16_t padding_1 = 0;
  std::uint32_t padding_2 = 0;
};

struct EntityAssociation {
  static constexpr VariableParameterType kType = VariableParameterType::entity_association;
  VariableParameterType record_type = kType;
  std::uint8_t change_indicator = 0;
  std::uint8_t association_status = 0;
  std::uint8_t association_type = 0;
  EntityId entity_id;
  std::uint16_t own_station_location = 0;
  std::uint8_t physical_connection_type = 0;
  std::uint8_t group_member_type = 0;
  std::uint16_t group_number = 0;
};

inline constexpr std::size_t kVariableParameterSize = 16;  ///< octets, for any kind

/// Calls `f` with the record in its own type, or as VariableParameter if the kind is unknown.
/// `record` must have 16 octets, as in a decoded PDU; with fewer `f` is not called.
void visit_variable_parameter(std::span<const std::byte> record, auto&& f) {
  VariableParameter any;
  if (!load_record(record, any)) return;
  bool known = false;
  const auto as = [&]<typename Record>(Record typed) {
    static_assert(kFixedSize<Record> == kVariableParameterSize);
    if (any.record_type != Record::kType || !load_record(record, typed)) return;
    known = true;
    f(static_cast<const Record&>(typed));
  };
  as(ArticulatedPart{});
  as(AttachedPart{});
  as(Separation{});
  as(EntityTypeParameter{});
  as(EntityAssociation{});
  if (!known) f(static_cast<const VariableParameter&>(any));
}

}  // namespace reckon::pdu
