// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of the values of SISO-REF-010 (reprinted with permission from SISO Inc.). They are listed
// in siso_names.txt, and make_siso_names.py generates tables from them in the build.
// enumerations.hpp has the values that PDUs of this library use as types; the others are here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::pdu {

/// One list of values; `none` has no names. In the order of siso_names.txt.
enum class SisoTable : std::uint8_t {
  none,
  protocol_version,
  pdu_type,
  protocol_family,
  force_id,
  entity_kind,
  platform_domain,
  munition_domain,
  supply_domain,
  country,
  country_code,
  land_category,
  air_category,
  surface_category,
  subsurface_category,
  space_category,
  munition_category,
  land_life_form_category,
  air_life_form_category,
  surface_life_form_category,
  subsurface_life_form_category,
  space_life_form_category,
  land_environmental_category,
  air_environmental_category,
  surface_environmental_category,
  subsurface_environmental_category,
  land_cultural_category,
  surface_cultural_category,
  subsurface_cultural_category,
  supply_category,
  radio_category,
  air_expendable_category,
  surface_expendable_category,
  subsurface_expendable_category,
  sensor_category,
  dead_reckoning_algorithm,
  marking_character_set,
  variable_parameter_type,
  attached_part,
  articulated_part_class,
  articulated_part_metric,
  separation_reason,
  separation_pre_entity,
  change_indicator,
  detached_indicator,
  association_status,
  association_type,
  group_member_type,
  physical_connection_type,
  collision_type,
  warhead,
  fuse,
  detonation_result,
  pulse_shape,
  service_type,
  repair,
  repair_result,
  stop_freeze_reason,
  acknowledge_flag,
  response_flag,
  action_id,
  request_status,
  event_type,
  reliability_service,
  record_event_type,
  record_query_event_type,
  transfer_type,
  attribute_action,
  state_update_indicator,
  emitter_function,
  beam_function,
  high_density_track,
  beam_state,
  designator_name,
  designator_code,
  iff_system_type,
  iff_system_name,
  iff_system_mode,
  acoustic_update_indicator,
  acoustic_name,
  acoustic_function,
  scan_pattern,
  propulsion_plant,
  transmit_state,
  input_source,
  antenna_pattern_type,
  crypto_system,
  modulation,
  amplitude_detail,
  amplitude_angle_detail,
  angle_detail,
  combination_detail,
  pulse_detail,
  unmodulated_detail,
  phase_shift_detail,
  satcom_detail,
  radio_system,
  encoding_class,
  encoding_type,
  tdl_type,
  receiver_state,
  control_type,
  communications_type,
  communications_class,
  intercom_command,
  transmit_line_state,
  aggregate_state,
  formation,
  aggregate_kind,
  aggregate_subcategory,
  aggregate_specific,
  grouped_entity_category,
  relationship_nature,
  relationship_position,
  station_name,
  minefield_type,
  minefield_activity,
  minefield_lane,
  mine_sensor,
  protocol_mode,
  environment_record_type,
  environment_model_type,
  coordinate_system,
  constant_grid,
  object_kind,
  io_warfare_type,
  io_source,
  io_action_type,
  io_action_phase,
  io_report_type,
  grid_axis_type,
  data_representation,
  iff_data_category,
  iff_applicable_modes,
  antenna_reference_system,
  start_of_message,
  clear_channel,
  time_slot_allocation,
  jtids_primary_mode,
  jtids_secondary_mode,
  synchronization_state,
  off_on,
  no_yes,
  paint_scheme,
  damage,
  effect_size,
  hatch,
  launcher,
  camouflage,
  concealment,
  concealed_movement,
  entity_state,
  canopy,
  subsurface_hatch,
  health,
  compliance,
  posture,
  weapon,
  clothing,
  density,
  day_night,
  brightness,
  deployment,
  night_vision,
  parachute,
  flare_color,
  flare_status,
  chaff_status,
  cover,
  damage_area,
  object_damage,
  object_origin,
  ied,
  fire_update,
  live_virtual_constructive,
  transferred_entity,
  coupled_extension,
  fire_type,
  detonation_type,
  radio_attached,
  iff_simulation_mode,
  active_interrogation,
  datum_id,
  end_
};

/// A word whose bits are separate fields; `none` has no fields.
enum class SisoBits : std::uint8_t {
  none,
  land_appearance,
  air_appearance,
  surface_appearance,
  subsurface_appearance,
  space_appearance,
  munition_appearance,
  life_form_appearance,
  environmental_appearance,
  cultural_appearance,
  supply_appearance,
  radio_appearance,
  expendable_appearance,
  sensor_appearance,
  land_capabilities,
  air_capabilities,
  service_capabilities,
  carried_capabilities,
  supply_capabilities,
  animal_appearance,
  pdu_status,
  fire_status,
  detonation_status,
  radio_status,
  intercom_status,
  iff_status,
  articulated_parameter,
  encoding_scheme,
  data_scheme,
  communications_channel,
  frozen_behavior,
  minefield_appearance,
  mine_data_filter,
  mine_sensor_type,
  fire_flags,
  environment_status,
  object_appearance,
  object_modification,
  propulsion_plant_configuration,
  spread_spectrum,
  iff_system_status,
  end_
};

/// A value and its name.
struct SisoEntry {
  std::uint32_t value = 0;
  std::string_view name;
};

/// A field within a word of bits.
struct SisoBitField {
  std::string_view name;  ///< in snake case
  unsigned first = 0;     ///< bit, 0 is the least significant
  unsigned width = 1;     ///< bits
  SisoTable values = SisoTable::none;

  [[nodiscard]] constexpr std::uint32_t of(std::uint32_t word) const noexcept {
    return (word >> first) & (width >= 32 ? ~0U : (1U << width) - 1U);
  }
};

/// The name of a value, "" if it has none. Static text; no heap, at most 9 comparisons, or one for
/// a table without gaps.
[[nodiscard]] std::string_view siso_name(SisoTable table, std::uint32_t value) noexcept;

/// Number of values with names.
[[nodiscard]] std::size_t siso_size(SisoTable table) noexcept;
/// The i-th value with a name, ascending by value; i < siso_size(table).
[[nodiscard]] SisoEntry siso_entry(SisoTable table, std::size_t i) noexcept;

/// Number of named fields of a word.
[[nodiscard]] std::size_t siso_size(SisoBits bits) noexcept;
/// The i-th named field; i < siso_size(bits).
[[nodiscard]] SisoBitField siso_bit_field(SisoBits bits, std::size_t i) noexcept;
/// Whether a field with the value 0 is shown too, because 0 has a meaning, such as a part's metric.
[[nodiscard]] bool shows_zeros(SisoBits bits) noexcept;

/// Table of the domains for this kind of entity.
[[nodiscard]] SisoTable domain_table(EntityKind kind) noexcept;
/// Table of the categories for this kind and domain.
[[nodiscard]] SisoTable category_table(EntityKind kind, EntityDomain domain) noexcept;
/// Appearance fields of an entity of this kind, domain and category; life forms of category 200 and
/// above are animals.
[[nodiscard]] SisoBits appearance_bits(EntityKind kind, EntityDomain domain,
                                       std::uint8_t category) noexcept;
/// Capability fields of an entity of this kind and domain.
[[nodiscard]] SisoBits capability_bits(EntityKind kind, EntityDomain domain) noexcept;

}  // namespace reckon::pdu
