// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::pdu {
namespace {

using T = SisoTable;
using B = SisoBits;

struct Row {
  std::string_view field;
  FieldMeaning meaning;
};

constexpr Row values(std::string_view field, SisoTable table) { return {field, {table, B::none}}; }
constexpr Row bits(std::string_view field, SisoBits set) { return {field, {T::none, set}}; }

/// THE list of fields whose values have names, sorted by field name.
constexpr auto kFields = std::to_array<Row>({
    values("acoustic_function", T::acoustic_function),
    values("acoustic_system_name", T::acoustic_name),
    values("action_id", T::action_id),
    values("aggregate_marking_character_set", T::marking_character_set),
    values("aggregate_state", T::aggregate_state),
    values("antenna_pattern_type", T::antenna_pattern_type),
    bits("appearance", B::minefield_appearance),
    values("applicable_modes", T::iff_applicable_modes),
    values("association_status", T::association_status),
    values("association_type", T::association_type),
    values("attribute_record_protocol_version", T::protocol_version),
    values("axis_type", T::grid_axis_type),
    values("beam_function", T::beam_function),
    values("beam_status", T::beam_state),
    values("change_indicator", T::change_indicator),
    values("clear_channel", T::clear_channel),
    values("code_name", T::designator_name),
    values("command", T::intercom_command),
    bits("communications_channel_type", B::communications_channel),
    values("constant_grid", T::constant_grid),
    values("control_type", T::control_type),
    values("coordinate_system", T::coordinate_system),
    values("country", T::country),
    values("crypto_system", T::crypto_system),
    values("data_category", T::iff_data_category),
    bits("data_filter", B::mine_data_filter),
    values("data_representation", T::data_representation),
    values("datum_id", T::datum_id),
    values("designator_code", T::designator_code),
    values("detached_indicator", T::detached_indicator),
    values("detonation_result", T::detonation_result),
    values("emitter_function", T::emitter_function),
    bits("encoding_scheme", B::encoding_scheme),
    // An update does not state the kind of the entity: these bits are the same for all.
    bits("entity_appearance", B::radio_appearance),
    bits("environment_status", B::environment_status),
    values("event_type", T::event_type),
    values("fixed_datum_id", T::datum_id),
    values("formation", T::formation),
    bits("frozen_behavior", B::frozen_behavior),
    values("fuse", T::fuse),
    bits("general_object_appearance", B::object_appearance),
    bits("general_segment_appearance", B::object_appearance),
    values("group_member_type", T::group_member_type),
    values("grouped_entity_category", T::grouped_entity_category),
    values("high_density_track_jam", T::high_density_track),
    values("input_source", T::input_source),
    values("io_action_phase", T::io_action_phase),
    values("io_action_type", T::io_action_type),
    values("io_report_type", T::io_report_type),
    values("io_simulation_source", T::io_source),
    values("io_warfare_type", T::io_warfare_type),
    values("model_type", T::environment_model_type),
    bits("modifications", B::object_modification),
    values("own_station_location", T::station_name),
    bits("parameter_type", B::articulated_parameter),
    values("physical_connection_type", T::physical_connection_type),
    values("pre_entity_indicator", T::separation_pre_entity),
    bits("propulsion_plant_configuration", B::propulsion_plant_configuration),
    values("protocol_mode", T::protocol_mode),
    values("protocol_version", T::protocol_version),
    values("pulse_shape", T::pulse_shape),
    values("reason_for_separation", T::separation_reason),
    values("receiver_state", T::receiver_state),
    values("record_id", T::datum_id),
    values("reference_system", T::antenna_reference_system),
    values("relationship_nature", T::relationship_nature),
    values("relationship_position", T::relationship_position),
    values("repair", T::repair),
    values("repair_result", T::repair_result),
    values("request_status", T::request_status),
    values("required_reliability_service", T::reliability_service),
    values("response_status", T::request_status),
    values("scan_pattern", T::scan_pattern),
    bits("segment_modification", B::object_modification),
    bits("sensor_type", B::mine_sensor_type),
    values("service_type_requested", T::service_type),
    values("start_of_message", T::start_of_message),
    values("state_change_update_indicator", T::acoustic_update_indicator),
    values("state_update_indicator", T::state_update_indicator),
    values("station_name", T::station_name),
    values("synchronization_state", T::synchronization_state),
    values("system_mode", T::iff_system_mode),
    values("system_name", T::iff_system_name),
    bits("system_status", B::iff_system_status),
    values("system_type", T::iff_system_type),
    values("tdl_type", T::tdl_type),
    values("time_slot_allocation_mode", T::time_slot_allocation),
    values("transfer_type", T::transfer_type),
    values("transmit_line_state", T::transmit_line_state),
    values("transmit_state", T::transmit_state),
    values("transmitting_terminal_primary_mode", T::jtids_primary_mode),
    values("transmitting_terminal_secondary_mode", T::jtids_secondary_mode),
    values("variable_datum_id", T::datum_id),
    values("warhead", T::warhead),
});

static_assert(std::is_sorted(kFields.begin(), kFields.end(),
                             [](const Row& a, const Row& b) { return a.field < b.field; }));

constexpr std::size_t kSlots = 512;
constexpr std::uint8_t kFree = 0xFF;

// Where a row of this name is, or a row after it, or else a free slot: most names have no row, and
// are not compared with any. A name has at least one character.
constexpr std::size_t slot_of(std::string_view field) {
  const auto letter = [&](std::size_t i) { return static_cast<unsigned char>(field[i]); };
  const std::size_t n = field.size();
  return (n + 5U * letter(0) + 31U * letter(n / 2) + 131U * letter(n - 1)) % kSlots;
}

// Rows by name: open addressing.
constexpr auto kRows = [] {
  std::array<std::uint8_t, kSlots> rows{};
  rows.fill(kFree);
  static_assert(kFields.size() < kFree);
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    std::size_t slot = slot_of(kFields[i].field);
    while (rows[slot] != kFree) slot = (slot + 1) % kSlots;
    rows[slot] = static_cast<std::uint8_t>(i);
  }
  return rows;
}();

FieldMeaning value_of(SisoTable table) { return {table, B::none}; }
FieldMeaning bits_of(SisoBits set) { return {T::none, set}; }

SisoBits status_bits(PduType type) {
  switch (type) {
    case PduType::fire:
      return B::fire_status;
    case PduType::detonation:
      return B::detonation_status;
    case PduType::transmitter:
    case PduType::signal:
    case PduType::receiver:
      return B::radio_status;
    case PduType::intercom_signal:
    case PduType::intercom_control:
      return B::intercom_status;
    case PduType::iff:
      return B::iff_status;
    default:
      return B::pdu_status;
  }
}

/// The low bits of an encoding scheme are an audio code only for audio.
FieldMeaning in_signal(const auto& pdu, std::string_view field) {
  if (field == "encoding_scheme" && pdu.encoding_scheme >> 14U != 0) return bits_of(B::data_scheme);
  return field_meaning(field);
}

/// Tables for the detail of a modulation, by the major modulation.
constexpr std::array kModulationDetails{T::none,
                                        T::amplitude_detail,
                                        T::amplitude_angle_detail,
                                        T::angle_detail,
                                        T::combination_detail,
                                        T::pulse_detail,
                                        T::unmodulated_detail,
                                        T::phase_shift_detail,
                                        T::satcom_detail};

}  // namespace

FieldMeaning field_meaning(std::string_view field) noexcept {
  if (field.empty()) return {};
  for (std::size_t slot = slot_of(field); kRows[slot] != kFree; slot = (slot + 1) % kSlots)
    if (const Row& row = kFields[kRows[slot]]; row.field == field) return row.meaning;
  return {};
}

FieldMeaning meaning_in(const PduHeader& record, std::string_view field) noexcept {
  // Before version 7 the status was padding.
  if (field == "pdu_status" && record.protocol_version >= 7)
    return bits_of(status_bits(record.pdu_type));
  return field_meaning(field);
}

FieldMeaning meaning_in(const EntityType& record, std::string_view field) noexcept {
  if (field == "domain") return value_of(domain_table(record.kind));
  if (field == "category") return value_of(category_table(record.kind, record.domain));
  return field_meaning(field);
}

FieldMeaning meaning_in(const AggregateType&, std::string_view field) noexcept {
  if (field == "kind") return value_of(T::aggregate_kind);
  if (field == "subcategory") return value_of(T::aggregate_subcategory);
  if (field == "specific") return value_of(T::aggregate_specific);
  return field_meaning(field);
}

FieldMeaning meaning_in(const ObjectType&, std::string_view field) noexcept {
  if (field == "domain") return value_of(T::platform_domain);
  return field == "kind" ? value_of(T::object_kind) : FieldMeaning{};
}

FieldMeaning meaning_in(const EntityState& record, std::string_view field) noexcept {
  const EntityType& type = record.entity_type;
  if (field == "entity_appearance")
    return bits_of(appearance_bits(type.kind, type.domain, type.category));
  if (field == "capabilities") return bits_of(capability_bits(type.kind, type.domain));
  return field_meaning(field);
}

FieldMeaning meaning_in(const Appearance& record, std::string_view field) noexcept {
  const EntityType& type = record.entity_type;
  if (field == "visual_appearance")
    return bits_of(appearance_bits(type.kind, type.domain, type.category));
  if (field == "capabilities") return bits_of(capability_bits(type.kind, type.domain));
  return field_meaning(field);
}

FieldMeaning meaning_in(const RadioEntityType& record, std::string_view field) noexcept {
  if (field == "domain") return value_of(domain_table(record.kind));
  if (field == "category") return value_of(category_table(record.kind, record.domain));
  return field_meaning(field);
}

FieldMeaning meaning_in(const AttachedPart&, std::string_view field) noexcept {
  return field == "parameter_type" ? value_of(T::attached_part) : field_meaning(field);
}

FieldMeaning meaning_in(const ModulationType& record, std::string_view field) noexcept {
  if (field == "major_modulation") return value_of(T::modulation);
  if (field == "radio_system") return value_of(T::radio_system);
  if (field == "spread_spectrum") return bits_of(B::spread_spectrum);
  if (field != "detail" || record.major_modulation >= kModulationDetails.size()) return {};
  return value_of(kModulationDetails[record.major_modulation]);
}

FieldMeaning meaning_in(const DirectedEnergyFire&, std::string_view field) noexcept {
  return field == "flags" ? bits_of(B::fire_flags) : field_meaning(field);
}

FieldMeaning meaning_in(const EnvironmentRecord&, std::string_view field) noexcept {
  return field == "record_type" ? value_of(T::environment_record_type) : field_meaning(field);
}

FieldMeaning meaning_in(const StandardVariableRecord&, std::string_view field) noexcept {
  return field == "record_type" ? value_of(T::datum_id) : field_meaning(field);
}

FieldMeaning meaning_in(const Signal& record, std::string_view field) noexcept {
  return in_signal(record, field);
}

FieldMeaning meaning_in(const IntercomSignal& record, std::string_view field) noexcept {
  return in_signal(record, field);
}

FieldMeaning meaning_in(const RecordR&, std::string_view field) noexcept {
  return field == "event_type" ? value_of(T::record_event_type) : field_meaning(field);
}

FieldMeaning meaning_in(const RecordQueryR&, std::string_view field) noexcept {
  return field == "event_type" ? value_of(T::record_query_event_type) : field_meaning(field);
}

}  // namespace reckon::pdu
