-- SPDX-FileCopyrightText: 2026 The Reckon authors
-- SPDX-License-Identifier: Apache-2.0
-- Wireshark and tshark: every PDU of a DIS bundle, each with the fields that Wireshark's own DIS
-- dissector knows, and the Attribute records and experimental PDUs of Reckon. Faults have the rule
-- names of `reckon inspect`.
--   tshark -X lua_script:reckon.lua -r capture.pcapng -Y 'reckon.haptic.k1 > 400'
-- Lua 5.2 (Wireshark 3 and 4.0 to 4.2) and 5.4. See docs/wireshark.md.

-- BEGIN of the tables that reckon_lua_tables writes
local OLDEST_VERSION, NEWEST_VERSION, HEADER_SIZE = 5, 7, 12
local RULES = {
  ["E-TRUNCATED"] = "The datagram ends before the PDU does.",
  ["E-LENGTH"] = "The length field is too small for a PDU of this type.",
  ["E-COUNT"] = "More records are announced than octets are left in the PDU.",
  ["E-RECORD"] = "A record's length is too small or runs past the end of the PDU.",
  ["E-VERSION"] = "The protocol or record version is not supported.",
  ["E-TYPE"] = "The octets are of another type than the one asked for.",
  ["E-STRAY"] = "Octets behind the last PDU are neither padding nor a PDU.",
  ["I-UNKNOWN-TYPE"] = "No field table for this PDU type: its octets are kept as they are.",
  ["W-NOT-FINITE"] = "A field holds NaN or infinity.",
}
local PDUS = {
  [1] = { name = "entity_state", family = 1, size = 144, id = 12,
    floats = {
      36, 4, "entity_linear_velocity.x", 40, 4, "entity_linear_velocity.y",
      44, 4, "entity_linear_velocity.z", 48, 8, "entity_location.x", 56, 8, "entity_location.y",
      64, 8, "entity_location.z", 72, 4, "entity_orientation.psi",
      76, 4, "entity_orientation.theta", 80, 4, "entity_orientation.phi",
      104, 4, "dead_reckoning_parameters.entity_linear_acceleration.x",
      108, 4, "dead_reckoning_parameters.entity_linear_acceleration.y",
      112, 4, "dead_reckoning_parameters.entity_linear_acceleration.z",
      116, 4, "dead_reckoning_parameters.entity_angular_velocity.x",
      120, 4, "dead_reckoning_parameters.entity_angular_velocity.y",
      124, 4, "dead_reckoning_parameters.entity_angular_velocity.z", },
    blocks = {
      { kind = "records", name = "variable_parameters",
        at = 19, width = 1, count = "number_of_variable_parameter_records", size = 16 },
    } },
  [2] = { name = "fire", family = 2, size = 96, id = 12,
    floats = {
      40, 8, "location_in_world_coordinates.x", 48, 8, "location_in_world_coordinates.y",
      56, 8, "location_in_world_coordinates.z", 80, 4, "velocity.x", 84, 4, "velocity.y",
      88, 4, "velocity.z", 92, 4, "range", },
    blocks = {} },
  [3] = { name = "detonation", family = 2, size = 104, id = 12,
    floats = {
      36, 4, "velocity.x", 40, 4, "velocity.y", 44, 4, "velocity.z",
      48, 8, "location_in_world_coordinates.x", 56, 8, "location_in_world_coordinates.y",
      64, 8, "location_in_world_coordinates.z", 88, 4, "location_in_entity_coordinates.x",
      92, 4, "location_in_entity_coordinates.y", 96, 4, "location_in_entity_coordinates.z", },
    blocks = {
      { kind = "records", name = "variable_parameters",
        at = 101, width = 1, count = "number_of_variable_parameter_records", size = 16 },
    } },
  [4] = { name = "collision", family = 1, size = 60, id = 12,
    floats = {
      32, 4, "velocity.x", 36, 4, "velocity.y", 40, 4, "velocity.z", 44, 4, "mass",
      48, 4, "location.x", 52, 4, "location.y", 56, 4, "location.z", },
    blocks = {} },
  [5] = { name = "service_request", family = 3, size = 28, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "supplies",
        at = 25, width = 1, count = "number_of_supply_types", size = 12,
        floats = {
          8, 4, "quantity", } },
    } },
  [6] = { name = "resupply_offer", family = 3, size = 28, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "supplies",
        at = 24, width = 1, count = "number_of_supply_types", size = 12,
        floats = {
          8, 4, "quantity", } },
    } },
  [7] = { name = "resupply_received", family = 3, size = 28, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "supplies",
        at = 24, width = 1, count = "number_of_supply_types", size = 12,
        floats = {
          8, 4, "quantity", } },
    } },
  [8] = { name = "resupply_cancel", family = 3, size = 24, id = 12,
    floats = {},
    blocks = {} },
  [9] = { name = "repair_complete", family = 3, size = 28, id = 12,
    floats = {},
    blocks = {} },
  [10] = { name = "repair_response", family = 3, size = 28, id = 12,
    floats = {},
    blocks = {} },
  [11] = { name = "create_entity", family = 5, size = 28, id = 12,
    floats = {},
    blocks = {} },
  [12] = { name = "remove_entity", family = 5, size = 28, id = 12,
    floats = {},
    blocks = {} },
  [13] = { name = "start_resume", family = 5, size = 44, id = 12,
    floats = {},
    blocks = {} },
  [14] = { name = "stop_freeze", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {} },
  [15] = { name = "acknowledge", family = 5, size = 32, id = 12,
    floats = {},
    blocks = {} },
  [16] = { name = "action_request", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [17] = { name = "action_response", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [18] = { name = "data_query", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_ids",
        at = 32, width = 4, count = "number_of_fixed_datum_ids", size = 4 },
      { kind = "records", name = "variable_datum_ids",
        at = 36, width = 4, count = "number_of_variable_datum_ids", size = 4 },
    } },
  [19] = { name = "set_data", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [20] = { name = "data", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [21] = { name = "event_report", family = 5, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [22] = { name = "comment", family = 5, size = 32, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 24, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 28, width = 4, count = "number_of_variable_datum_records" },
    } },
  [23] = { name = "electromagnetic_emission", family = 6, size = 28, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "systems",
        at = 25, width = 1, count = "number_of_systems" },
    } },
  [24] = { name = "designator", family = 6, size = 88, id = 12,
    floats = {
      28, 4, "designator_power", 32, 4, "designator_wavelength",
      36, 4, "designator_spot_with_respect_to_designated_entity.x",
      40, 4, "designator_spot_with_respect_to_designated_entity.y",
      44, 4, "designator_spot_with_respect_to_designated_entity.z",
      48, 8, "designator_spot_location.x", 56, 8, "designator_spot_location.y",
      64, 8, "designator_spot_location.z", 76, 4, "spot_linear_acceleration.x",
      80, 4, "spot_linear_acceleration.y", 84, 4, "spot_linear_acceleration.z", },
    blocks = {} },
  [25] = { name = "transmitter", family = 4, size = 104, id = 12,
    floats = {
      32, 8, "antenna_location.x", 40, 8, "antenna_location.y", 48, 8, "antenna_location.z",
      56, 4, "relative_antenna_location.x", 60, 4, "relative_antenna_location.y",
      64, 4, "relative_antenna_location.z", 80, 4, "transmit_frequency_bandwidth",
      84, 4, "power", },
    blocks = {
      { kind = "octets", name = "modulation_parameters",
        at = 100, width = 1, count = "length_of_modulation_parameters" },
      { kind = "octets", name = "antenna_pattern",
        at = 70, width = 2, count = "length_of_antenna_pattern" },
      { kind = "other", name = "variable_transmitter_parameters",
        at = 30, width = 2, count = "number_of_variable_transmitter_parameters" },
    } },
  [26] = { name = "signal", family = 4, size = 32, id = 12,
    floats = {},
    blocks = {
      { kind = "bits", name = "data",
        at = 28, width = 2, count = "data_length" },
    } },
  [27] = { name = "receiver", family = 4, size = 36, id = 12,
    floats = {
      24, 4, "received_power", },
    blocks = {} },
  [28] = { name = "iff", family = 6, size = 60, id = 12,
    floats = {
      24, 4, "relative_antenna_location.x", 28, 4, "relative_antenna_location.y",
      32, 4, "relative_antenna_location.z", },
    blocks = {
      { kind = "other", name = "layers" },
    } },
  [29] = { name = "underwater_acoustic", family = 6, size = 32, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "shafts",
        at = 29, width = 1, count = "number_of_shafts", size = 8 },
      { kind = "records", name = "additional_passive_activities",
        at = 30, width = 1, count = "number_of_additional_passive_activities", size = 4 },
      { kind = "other", name = "emitter_systems",
        at = 31, width = 1, count = "number_of_emitter_systems" },
    } },
  [30] = { name = "supplemental_emission_entity_state", family = 6, size = 28, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "propulsion_systems",
        at = 24, width = 2, count = "number_of_propulsion_systems", size = 8,
        floats = {
          0, 4, "power_setting", 4, 4, "engine_rpm", } },
      { kind = "records", name = "vectoring_nozzle_systems",
        at = 26, width = 2, count = "number_of_vectoring_nozzle_systems", size = 8,
        floats = {
          0, 4, "horizontal_deflection_angle", 4, 4, "vertical_deflection_angle", } },
    } },
  [31] = { name = "intercom_signal", family = 4, size = 32, id = 12,
    floats = {},
    blocks = {
      { kind = "bits", name = "data",
        at = 28, width = 2, count = "data_length" },
    } },
  [32] = { name = "intercom_control", family = 4, size = 40, id = 14,
    floats = {},
    blocks = {
      { kind = "octets", name = "intercom_parameters",
        at = 36, width = 4, count = "length_of_intercom_parameters" },
    } },
  [33] = { name = "aggregate_state", family = 7, size = 132, id = 12,
    floats = {
      64, 4, "dimensions.x", 68, 4, "dimensions.y", 72, 4, "dimensions.z",
      76, 4, "orientation.psi", 80, 4, "orientation.theta", 84, 4, "orientation.phi",
      88, 8, "center_of_mass.x", 96, 8, "center_of_mass.y", 104, 8, "center_of_mass.z",
      112, 4, "velocity.x", 116, 4, "velocity.y", 120, 4, "velocity.z", },
    blocks = {
      { kind = "records", name = "aggregate_ids",
        at = 124, width = 2, count = "number_of_aggregates", size = 6 },
      { kind = "records", name = "entity_ids",
        at = 126, width = 2, count = "number_of_entities", size = 6 },
      { kind = "rest", name = "padding_to_32_bits" },
      { kind = "records", name = "silent_aggregate_systems", size = 12 },
      { kind = "other", name = "silent_entity_systems" },
    } },
  [34] = { name = "is_group_of", family = 7, size = 40, id = 12,
    floats = {
      24, 8, "latitude", 32, 8, "longitude", },
    blocks = {
      { kind = "rest", name = "grouped_entity_descriptions" },
    } },
  [35] = { name = "transfer_ownership", family = 7, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "record_sets",
        at = 36, width = 4, count = "number_of_record_sets" },
    } },
  [36] = { name = "is_part_of", family = 7, size = 52, id = 12,
    floats = {
      28, 4, "part_location.x", 32, 4, "part_location.y", 36, 4, "part_location.z", },
    blocks = {} },
  [37] = { name = "minefield_state", family = 8, size = 72, id = 12,
    floats = {
      32, 8, "minefield_location.x", 40, 8, "minefield_location.y",
      48, 8, "minefield_location.z", 56, 4, "minefield_orientation.psi",
      60, 4, "minefield_orientation.theta", 64, 4, "minefield_orientation.phi", },
    blocks = {
      { kind = "records", name = "perimeter_points",
        at = 21, width = 1, count = "number_of_perimeter_points", size = 8,
        floats = {
          0, 4, "x", 4, 4, "y", } },
      { kind = "records", name = "mine_types",
        at = 30, width = 2, count = "number_of_mine_types", size = 8 },
    } },
  [38] = { name = "minefield_query", family = 8, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "requested_perimeter_points",
        at = 25, width = 1, count = "number_of_perimeter_points", size = 8,
        floats = {
          0, 4, "x", 4, 4, "y", } },
      { kind = "records", name = "sensor_types",
        at = 27, width = 1, count = "number_of_sensor_types", size = 2 },
      { kind = "rest", name = "padding_to_32_bits" },
    } },
  [39] = { name = "minefield_data", family = 8, size = 44, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "sensor_types",
        at = 30, width = 1, count = "number_of_sensor_types", size = 2 },
      { kind = "rest", name = "mines" },
    } },
  [40] = { name = "minefield_response_nack", family = 8, size = 26, id = 12,
    floats = {},
    blocks = {
      { kind = "octets", name = "missing_pdu_sequence_numbers",
        at = 25, width = 1, count = "number_of_missing_pdus" },
      { kind = "rest", name = "padding_to_32_bits" },
    } },
  [41] = { name = "environmental_process", family = 9, size = 32, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "environment_records",
        at = 28, width = 2, count = "number_of_environment_records" },
    } },
  [42] = { name = "gridded_data", family = 9, size = 64, id = 12,
    floats = {
      36, 4, "orientation.psi", 40, 4, "orientation.theta", 44, 4, "orientation.phi", },
    blocks = {
      { kind = "other", name = "grid_axes" },
      { kind = "other", name = "grid_data" },
    } },
  [43] = { name = "point_object_state", family = 9, size = 88, id = 12,
    floats = {
      32, 8, "object_location.x", 40, 8, "object_location.y", 48, 8, "object_location.z",
      56, 4, "object_orientation.psi", 60, 4, "object_orientation.theta",
      64, 4, "object_orientation.phi", },
    blocks = {} },
  [44] = { name = "linear_object_state", family = 9, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "linear_segments",
        at = 27, width = 1, count = "number_of_linear_segments", size = 64,
        floats = {
          8, 8, "segment_location.x", 16, 8, "segment_location.y", 24, 8, "segment_location.z",
          32, 4, "segment_orientation.psi", 36, 4, "segment_orientation.theta",
          40, 4, "segment_orientation.phi", 44, 4, "segment_length", 48, 4, "segment_width",
          52, 4, "segment_height", 56, 4, "segment_depth", } },
    } },
  [45] = { name = "areal_object_state", family = 9, size = 48, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "points",
        at = 38, width = 2, count = "number_of_points", size = 24,
        floats = {
          0, 8, "x", 8, 8, "y", 16, 8, "z", } },
    } },
  [46] = { name = "tspi", family = 11, size = 25,
    floats = {},
    blocks = {} },
  [47] = { name = "appearance", family = 11, size = 17,
    floats = {},
    blocks = {} },
  [48] = { name = "articulated_parts", family = 11, size = 17,
    floats = {},
    blocks = {
      { kind = "records", name = "variable_parameters",
        at = 16, width = 1, count = "number_of_variable_parameter_records", size = 16 },
    } },
  [49] = { name = "le_fire", family = 11, size = 35,
    floats = {},
    blocks = {} },
  [50] = { name = "le_detonation", family = 11, size = 40,
    floats = {},
    blocks = {} },
  [51] = { name = "create_entity_r", family = 10, size = 32, id = 12,
    floats = {},
    blocks = {} },
  [52] = { name = "remove_entity_r", family = 10, size = 32, id = 12,
    floats = {},
    blocks = {} },
  [53] = { name = "start_resume_r", family = 10, size = 48, id = 12,
    floats = {},
    blocks = {} },
  [54] = { name = "stop_freeze_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {} },
  [55] = { name = "acknowledge_r", family = 10, size = 32, id = 12,
    floats = {},
    blocks = {} },
  [56] = { name = "action_request_r", family = 10, size = 44, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 36, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 40, width = 4, count = "number_of_variable_datum_records" },
    } },
  [57] = { name = "action_response_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [58] = { name = "data_query_r", family = 10, size = 44, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_ids",
        at = 36, width = 4, count = "number_of_fixed_datum_ids", size = 4 },
      { kind = "records", name = "variable_datum_ids",
        at = 40, width = 4, count = "number_of_variable_datum_ids", size = 4 },
    } },
  [59] = { name = "set_data_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [60] = { name = "data_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [61] = { name = "event_report_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 32, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 36, width = 4, count = "number_of_variable_datum_records" },
    } },
  [62] = { name = "comment_r", family = 10, size = 32, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "fixed_datum_records",
        at = 24, width = 4, count = "number_of_fixed_datum_records", size = 8 },
      { kind = "datums", name = "variable_datum_records",
        at = 28, width = 4, count = "number_of_variable_datum_records" },
    } },
  [63] = { name = "record_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "record_sets",
        at = 36, width = 4, count = "number_of_record_sets" },
    } },
  [64] = { name = "set_record_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "record_sets",
        at = 36, width = 4, count = "number_of_record_sets" },
    } },
  [65] = { name = "record_query_r", family = 10, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "records", name = "record_ids",
        at = 36, width = 4, count = "number_of_record_ids", size = 4 },
    } },
  [66] = { name = "collision_elastic", family = 1, size = 100, id = 12,
    floats = {
      32, 4, "contact_velocity.x", 36, 4, "contact_velocity.y", 40, 4, "contact_velocity.z",
      44, 4, "mass", 48, 4, "location_of_impact.x", 52, 4, "location_of_impact.y",
      56, 4, "location_of_impact.z", 60, 4, "collision_intermediate_result.xx",
      64, 4, "collision_intermediate_result.xy", 68, 4, "collision_intermediate_result.xz",
      72, 4, "collision_intermediate_result.yy", 76, 4, "collision_intermediate_result.yz",
      80, 4, "collision_intermediate_result.zz", 84, 4, "unit_surface_normal.x",
      88, 4, "unit_surface_normal.y", 92, 4, "unit_surface_normal.z",
      96, 4, "coefficient_of_restitution", },
    blocks = {} },
  [67] = { name = "entity_state_update", family = 1, size = 72, id = 12,
    floats = {
      20, 4, "entity_linear_velocity.x", 24, 4, "entity_linear_velocity.y",
      28, 4, "entity_linear_velocity.z", 32, 8, "entity_location.x", 40, 8, "entity_location.y",
      48, 8, "entity_location.z", 56, 4, "entity_orientation.psi",
      60, 4, "entity_orientation.theta", 64, 4, "entity_orientation.phi", },
    blocks = {
      { kind = "records", name = "variable_parameters",
        at = 19, width = 1, count = "number_of_variable_parameter_records", size = 16 },
    } },
  [68] = { name = "directed_energy_fire", family = 2, size = 88, id = 12,
    floats = {
      40, 4, "cumulative_shot_time", 44, 4, "aperture_emitter_location.x",
      48, 4, "aperture_emitter_location.y", 52, 4, "aperture_emitter_location.z",
      56, 4, "aperture_diameter", 60, 4, "wavelength", 68, 4, "pulse_repetition_frequency",
      72, 4, "pulse_width", },
    blocks = {
      { kind = "other", name = "directed_energy_records",
        at = 86, width = 2, count = "number_of_directed_energy_records" },
    } },
  [69] = { name = "entity_damage_status", family = 2, size = 24, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "damage_description_records",
        at = 22, width = 2, count = "number_of_damage_description_records" },
    } },
  [70] = { name = "information_operations_action", family = 13, size = 56, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "io_records",
        at = 54, width = 2, count = "number_of_io_records" },
    } },
  [71] = { name = "information_operations_report", family = 13, size = 40, id = 12,
    floats = {},
    blocks = {
      { kind = "other", name = "io_records",
        at = 38, width = 2, count = "number_of_io_records" },
    } },
  [72] = { name = "attribute", family = 1, size = 32,
    floats = {},
    blocks = {
      { kind = "attribute_sets", name = "attribute_record_sets",
        at = 30, width = 2, count = "number_of_attribute_record_sets" },
    } },
  [140] = { name = "presence", family = 129, size = 160,
    floats = {
      60, 4, "cell_size", 64, 8, "scene_origin.x", 72, 8, "scene_origin.y",
      80, 8, "scene_origin.z", 88, 4, "interest_radius", },
    blocks = {} },
  [141] = { name = "datagram_trailer", family = 129, size = 24,
    floats = {},
    blocks = {} },
  [142] = { name = "cell_membership", family = 129, size = 32,
    floats = {},
    blocks = {
      { kind = "records", name = "cells",
        at = 22, width = 2, count = "number_of_cells", size = 8 },
    } },
  [143] = { name = "time_exchange", family = 129, size = 24,
    floats = {},
    blocks = {
      { kind = "records", name = "echoes",
        at = 20, width = 2, count = "number_of_echoes", size = 12 },
    } },
  [144] = { name = "peers_heard", family = 129, size = 24,
    floats = {},
    blocks = {
      { kind = "records", name = "peers",
        at = 20, width = 2, count = "number_of_peers", size = 4 },
    } },
  [145] = { name = "cell_roles", family = 129, size = 24,
    floats = {},
    blocks = {
      { kind = "records", name = "roles",
        at = 20, width = 2, count = "number_of_roles", size = 40 },
    } },
  [146] = { name = "group_map", family = 129, size = 32,
    floats = {},
    blocks = {
      { kind = "records", name = "groups",
        at = 30, width = 2, count = "number_of_groups", size = 16 },
    } },
  [147] = { name = "cell_snapshot", family = 129, size = 36,
    floats = {},
    blocks = {
      { kind = "octets", name = "states",
        at = 34, width = 2, count = "states_length" },
    } },
  [148] = { name = "unicast_frame", family = 129, size = 16,
    floats = {},
    blocks = {} },
  [149] = { name = "compressed_states", family = 129, size = 20,
    floats = {},
    blocks = {
      { kind = "rest", name = "states" },
    } },
  [150] = { name = "assured_record", family = 129, size = 32,
    floats = {},
    blocks = {
      { kind = "records", name = "addressees",
        at = 28, width = 2, count = "number_of_addressees", size = 4 },
      { kind = "octets", name = "content",
        at = 30, width = 2, count = "content_length" },
    } },
}
local PDU_NAMES = {}
for number, pdu in pairs(PDUS) do PDU_NAMES[number] = pdu.name end
local OWN = {
  header = { size = 12, fields = {
    { "protocol_version", 0, 1, "u8" },
    { "exercise_id", 1, 1, "u8" },
    { "pdu_type", 2, 1, "u8", PDU_NAMES },
    { "protocol_family", 3, 1, "u8", {
      [0] = "Other", [1] = "Entity Information/Interaction", [2] = "Warfare", [3] = "Logistics",
      [4] = "Radio Communications", [5] = "Simulation Management",
      [6] = "Distributed Emission Regeneration", [7] = "Entity Management", [8] = "Minefield",
      [9] = "Synthetic Environment", [10] = "Simulation Management with Reliability",
      [11] = "Live Entity (LE) Information/Interaction", [12] = "Non-Real-Time",
      [13] = "Information Operations", [129] = "Experimental", } },
    { "timestamp", 4, 4, "u32" },
    { "length", 8, 2, "u16" },
    { "pdu_status", 10, 1, "u8" },
    { "padding", 11, 1, "u8" },
  } },
  attribute = { size = 32, fields = {
    { "originating_simulation_address.site", 12, 2, "u16" },
    { "originating_simulation_address.application", 14, 2, "u16" },
    { "padding_1", 16, 4, "u32" },
    { "padding_2", 20, 2, "u16" },
    { "attribute_record_pdu_type", 22, 1, "u8", PDU_NAMES },
    { "attribute_record_protocol_version", 23, 1, "u8" },
    { "master_attribute_record_type", 24, 4, "u32" },
    { "action_code", 28, 1, "u8", {
      [0] = "No Statement", } },
    { "padding_3", 29, 1, "u8" },
    { "number_of_attribute_record_sets", 30, 2, "u16" },
  } },
  haptic = { size = 72, type = 0x48415001, version = 1, fields = {
    { "record_type", 0, 4, "u32" },
    { "record_length", 4, 2, "u16" },
    { "version", 6, 1, "u8" },
    { "kind", 7, 1, "u8", {
      [0] = "None", [1] = "Plane", [2] = "Sphere", [3] = "Field", [4] = "Spring-damper region",
      [5] = "Modal", } },
    { "order", 8, 1, "u8" },
    { "flags", 9, 1, "u8" },
    { "surface", 10, 2, "u16" },
    { "validity_ms", 12, 2, "u16" },
    { "grip_stiffness", 14, 2, "u16" },
    { "k1", 16, 4, "f32" },
    { "k3", 20, 4, "f32" },
    { "damping", 24, 4, "f32" },
    { "mass", 28, 4, "f32" },
    { "point.x", 32, 4, "f32" },
    { "point.y", 36, 4, "f32" },
    { "point.z", 40, 4, "f32" },
    { "normal.x", 44, 4, "f32" },
    { "normal.y", 48, 4, "f32" },
    { "normal.z", 52, 4, "f32" },
    { "static_friction", 56, 4, "f32" },
    { "kinetic_friction", 60, 4, "f32" },
    { "restitution", 64, 4, "f32" },
    { "radius", 68, 4, "f32" },
  } },
  energy = { size = 24, type = 0x48415003, fields = {
    { "record_type", 0, 4, "u32" },
    { "record_length", 4, 2, "u16" },
    { "counterpart.site", 6, 2, "u16" },
    { "counterpart.application", 8, 2, "u16" },
    { "counterpart.entity", 10, 2, "u16" },
    { "given", 12, 8, "f64" },
    { "need", 20, 2, "u16" },
    { "spring_need", 22, 2, "u16" },
  } },
  ownership = { size = 24, type = 0x48415004, fields = {
    { "record_type", 0, 4, "u32" },
    { "record_length", 4, 2, "u16" },
    { "flags", 6, 1, "u8" },
    { "padding", 7, 1, "u8" },
    { "owner", 8, 4, "u32" },
    { "world", 12, 4, "u32" },
    { "version", 16, 8, "u64" },
  } },
  presence = { size = 160, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "pool_size", 20, 2, "u16" },
    { "port", 22, 2, "u16" },
    { "scene_hash", 24, 8, "u64" },
    { "send_time", 32, 8, "u64" },
    { "base_group", 40, 16, "octets" },
    { "cell_scheme", 56, 1, "u8", {
      [0] = "None", [1] = "Square", [2] = "Hexagonal", [3] = "Quad-Tree", [4] = "Locales", } },
    { "scene_peer", 57, 1, "u8" },
    { "flags", 58, 2, "u16" },
    { "cell_size", 60, 4, "f32" },
    { "scene_origin.x", 64, 8, "f64" },
    { "scene_origin.y", 72, 8, "f64" },
    { "scene_origin.z", 80, 8, "f64" },
    { "interest_radius", 88, 4, "f32" },
    { "started", 92, 4, "u32" },
    { "name", 96, 16, "text" },
    { "chain_number", 112, 4, "u32" },
    { "slot_time", 116, 4, "u32" },
    { "chain_link", 120, 16, "octets" },
    { "next_anchor", 136, 16, "octets" },
    { "address_mac", 152, 8, "octets" },
  } },
  trailer = { size = 24, fields = {
    { "sequence", 12, 4, "u32" },
    { "epoch", 16, 4, "u32" },
    { "send_time", 20, 4, "u32" },
  } },
  membership = { size = 32, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "action", 20, 1, "u8", {
      [0] = "None", [1] = "Join", [2] = "Leave", [3] = "Lead", [4] = "Resign",
      [5] = "Join Near", } },
    { "near_row", 21, 1, "u8" },
    { "number_of_cells", 22, 2, "u16" },
    { "since", 24, 8, "u64" },
  } },
  cell = { size = 8, fields = {
    { "column", 0, 4, "i32" },
    { "row", 4, 4, "i32" },
  } },
  exchange = { size = 24, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "number_of_echoes", 20, 2, "u16" },
    { "padding", 22, 2, "u16" },
  } },
  echo = { size = 12, fields = {
    { "epoch", 0, 4, "u32" },
    { "sent", 4, 4, "u32" },
    { "heard", 8, 4, "u32" },
  } },
  heard = { size = 24, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "number_of_peers", 20, 2, "u16" },
    { "continues", 22, 2, "u16" },
  } },
  peer = { size = 4, fields = {
    { "epoch", 0, 4, "u32" },
  } },
  roles = { size = 24, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "number_of_roles", 20, 2, "u16" },
    { "padding", 22, 2, "u16" },
  } },
  role = { size = 40, fields = {
    { "column", 0, 4, "i32" },
    { "row", 4, 4, "i32" },
    { "entered", 8, 8, "u64" },
    { "successor", 16, 4, "u32" },
    { "beacon", 20, 4, "u32" },
    { "flags", 24, 2, "u16" },
    { "serial", 26, 2, "u16" },
    { "first_part", 28, 2, "u16" },
    { "padding", 30, 2, "u16" },
    { "parts", 32, 8, "u64" },
  } },
  group_map = { size = 32, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "version", 20, 4, "u32" },
    { "part", 24, 2, "u16" },
    { "parts", 26, 2, "u16" },
    { "pool", 28, 2, "u16" },
    { "number_of_groups", 30, 2, "u16" },
  } },
  cell_group = { size = 16, fields = {
    { "column", 0, 4, "i32" },
    { "row", 4, 4, "i32" },
    { "beacon", 8, 4, "u32" },
    { "group", 12, 2, "u16" },
    { "padding", 14, 2, "u16" },
  } },
  snapshot = { size = 36, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "epoch", 16, 4, "u32" },
    { "column", 20, 4, "i32" },
    { "row", 24, 4, "i32" },
    { "serial", 28, 2, "u16" },
    { "part", 30, 2, "u16" },
    { "parts", 32, 2, "u16" },
    { "states_length", 34, 2, "u16" },
  } },
  compressed = { size = 20, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "form", 16, 1, "u8", {
      [0] = "None", [1] = "Compact", [2] = "Reserved", [3] = "Residual", } },
    { "layout", 17, 1, "u8" },
    { "number_of_states", 18, 2, "u16" },
  } },
  unicast = { size = 16, fields = {
    { "group", 12, 2, "u16" },
    { "padding", 14, 2, "u16" },
  } },
  assured = { size = 32, fields = {
    { "simulation_address.site", 12, 2, "u16" },
    { "simulation_address.application", 14, 2, "u16" },
    { "kind", 16, 1, "u8", {
      [0] = "None", [1] = "Record", [2] = "Mark", [3] = "Acknowledgement",
      [16] = "Ownership Round", [17] = "Ownership Proposal", [18] = "Ownership Vote",
      [19] = "Ownership Table", [20] = "Ownership Agreement", } },
    { "flags", 17, 1, "u8" },
    { "predecessor_distance", 18, 2, "u16" },
    { "epoch", 20, 4, "u32" },
    { "sequence", 24, 4, "u32" },
    { "number_of_addressees", 28, 2, "u16" },
    { "content_length", 30, 2, "u16" },
  } },
}
-- END of the tables

local reckon = Proto("reckon", "Reckon: DIS bundle")
local udp_ports = DissectorTable.get("udp.port")
local DIS_PORT = 3000
-- Up to Wireshark 4.0 the DIS dissector is found by its port, not by its name.
local dis = Dissector.get("dis") or udp_ports:get_dissector(DIS_PORT)

reckon.prefs.ports = Pref.range("UDP ports", "3000", "Ports whose datagrams are DIS", 65535)
reckon.prefs.other_ports = Pref.bool("Find DIS on other UDP ports", true,
  "Datagrams on other ports are taken for DIS where version, type, family and length agree")
reckon.prefs.inner = Pref.bool("Wireshark's own fields of each PDU", true,
  "Hands each PDU to Wireshark's DIS dissector, for its dis.* fields")

-- Fields and rules ------------------------------------------------------------------------------

local NUMBERS = {
  u8 = ProtoField.uint8, u16 = ProtoField.uint16, u32 = ProtoField.uint32, u64 = ProtoField.uint64,
  i8 = ProtoField.int8, i16 = ProtoField.int16, i32 = ProtoField.int32, i64 = ProtoField.int64,
}
local OTHERS = {
  f32 = ProtoField.float, f64 = ProtoField.double, text = ProtoField.string,
  octets = ProtoField.bytes,
}

local FIELD = {
  pdu = ProtoField.none("reckon.pdu", "PDU"),
  count = ProtoField.uint16("reckon.pdus", "PDUs in the datagram"),
  index = ProtoField.uint16("reckon.pdu.index", "Place in the datagram, from 1"),
  offset = ProtoField.uint16("reckon.pdu.offset", "Offset in the datagram"),
  type = ProtoField.uint8("reckon.pdu.type", "Type", base.DEC, PDU_NAMES),
  length = ProtoField.uint16("reckon.pdu.length", "Length by the header"),
  id = ProtoField.string("reckon.pdu.id", "Entity"),
  rule = ProtoField.string("reckon.pdu.rule", "Rule broken"),
  reason = ProtoField.string("reckon.pdu.reason", "Reason"),
  at = ProtoField.uint16("reckon.pdu.at", "Octet of the datagram at fault"),
  padding = ProtoField.bytes("reckon.padding", "Padding"),
  body = ProtoField.bytes("reckon.body", "Octets behind the header"),
  set = ProtoField.none("reckon.set", "Attribute record set"),
  set_id = ProtoField.string("reckon.set.id", "Entity"),
  set_records = ProtoField.uint16("reckon.set.number_of_attribute_records", "Records"),
  record = ProtoField.none("reckon.record", "Attribute record"),
  record_type = ProtoField.uint32("reckon.record.type", "Record type", base.HEX_DEC),
  record_length = ProtoField.uint16("reckon.record.length", "Record length"),
  record_body = ProtoField.bytes("reckon.record.body", "Octets of a record of another maker"),
}

local function register_fields()
  local all = {}
  for _, field in pairs(FIELD) do all[#all + 1] = field end
  for key, own in pairs(OWN) do
    for _, row in ipairs(own.fields) do
      local name, kind = "reckon." .. key .. "." .. row[1], row[4]
      if NUMBERS[kind] then
        -- Record types and hashes are usually written in hexadecimal.
        local form = row[1]:find("record_type$") or row[1]:find("hash$")
        row.field = NUMBERS[kind](name, row[1], form and base.HEX_DEC or base.DEC, row[5])
      else
        row.field = OTHERS[kind](name, row[1])
      end
      all[#all + 1] = row.field
    end
  end
  reckon.fields = all
end

local EXPERT = {}

local function register_rules()
  local severity = {
    E = expert.severity.ERROR, W = expert.severity.WARN, I = expert.severity.NOTE,
  }
  for rule, sentence in pairs(RULES) do
    local letter = rule:sub(1, 1)
    local group = letter == "I" and expert.group.UNDECODED or expert.group.MALFORMED
    EXPERT[rule] = ProtoExpert.new("reckon.rule." .. rule:lower():gsub("-", "_"),
      rule .. ": " .. sentence, group, severity[letter])
  end
  local all = {}
  for _, one in pairs(EXPERT) do all[#all + 1] = one end
  reckon.experts = all
end

register_fields()
register_rules()

-- Octets: `s` is the datagram as a string, `at` counts from 0 ----------------------------------

local function u16(s, at)
  local a, b = s:byte(at + 1, at + 2)
  return a * 0x100 + b
end

local function u32(s, at)
  local a, b, c, d = s:byte(at + 1, at + 4)
  return ((a * 0x100 + b) * 0x100 + c) * 0x100 + d
end

local function number_at(s, at, width)
  if width == 1 then return s:byte(at + 1) end
  return width == 2 and u16(s, at) or u32(s, at)
end

local function id_text(s, at)
  return string.format("%d:%d:%d", u16(s, at), u16(s, at + 2), u16(s, at + 4))
end

-- The exponent of NaN and infinity is all ones; infinity has no other bit.
local INFINITE = { [4] = "\128\0\0", [8] = "\240\0\0\0\0\0\0" }

local function is_finite(s, at, width)
  local a, b = s:byte(at + 1, at + 2)
  return a % 0x80 ~= 0x7F or b < (width == 8 and 0xF0 or 0x80)
end

local function fault(rule, at, reason, ...)
  return { rule = rule, at = at, reason = string.format(reason, ...) }
end

local function not_finite(s, at, floats, prefix)
  for i = 1, #floats, 3 do
    if not is_finite(s, at + floats[i], floats[i + 1]) then
      local infinite = s:sub(at + floats[i] + 2, at + floats[i] + floats[i + 1])
        == INFINITE[floats[i + 1]]
      return fault("W-NOT-FINITE", at + floats[i], "%s%s is %s", prefix, floats[i + 2],
        infinite and "infinite" or "NaN")
    end
  end
end

-- Variable parts: each takes the offsets of its block and of the end of the PDU, and returns the
-- offset of the end of the block, or nil and the fault ------------------------------------------

local BLOCKS = {}

function BLOCKS.records(s, pdu_at, block, at, stop)
  local count_at = pdu_at + block.at
  local count = number_at(s, count_at, block.width)
  local size = count * block.size
  if size <= stop - at then return at + size end
  return nil, fault("E-COUNT", count_at, "%s %.0f need %.0f octets, %d remain", block.count, count,
    size, stop - at)
end

local function too_long(block, count, at, stop)
  return nil, fault("E-COUNT", at, "%s of %.0f %s is longer than the %d octets that remain",
    block.name, count, block.kind, stop - at)
end

function BLOCKS.octets(s, pdu_at, block, at, stop)
  local count = number_at(s, pdu_at + block.at, block.width)
  if count <= stop - at then return at + count end
  return too_long(block, count, at, stop)
end

function BLOCKS.bits(s, pdu_at, block, at, stop)
  local count = number_at(s, pdu_at + block.at, block.width)
  local held = math.floor((count + 7) / 8)
  if held > stop - at then return too_long(block, count, at, stop) end
  return at + math.min(math.floor((held + 3) / 4) * 4, stop - at)
end

-- Octets of the variable datum at `at` with its padding, which the last one may lack. If it does
-- not fit, nil and the rule.
local function datum_size(s, at, stop)
  if stop - at < 8 then return nil, "E-COUNT" end
  local octets = math.floor((u32(s, at + 4) + 7) / 8)
  if octets > stop - at - 8 then return nil, "E-RECORD" end
  return 8 + math.min(math.floor((octets + 7) / 8) * 8, stop - at - 8)
end

function BLOCKS.datums(s, pdu_at, block, at, stop)
  local count = number_at(s, pdu_at + block.at, block.width)
  local number = 1
  while number <= count do
    local size, rule = datum_size(s, at, stop)
    if not size then
      return nil, fault(rule, at,
        "%s: number %d of %.0f does not fit into the %d octets that remain", block.name, number,
        count, stop - at)
    end
    number, at = number + 1, at + size
  end
  return at
end

-- One record of a set: the offset of its end, or nil and the fault.
local function step_record(s, at, stop, number, count, set)
  if stop - at < 6 then
    return nil, fault("E-COUNT", at,
      "record %d of %d in attribute record set %d needs 6 octets at least, %d remain", number,
      count, set, stop - at)
  end
  local length = u16(s, at + 4)
  if length >= 6 and length <= stop - at then return at + length end
  return nil, fault("E-RECORD", at,
    "record %d of %d in attribute record set %d says %d octets, %d remain", number, count, set,
    length, stop - at)
end

-- Calls on_set(at, count) and on_record(at, behind) for readable sets and records.
local function walk_sets(s, sets, at, stop, on_set, on_record)
  for set = 1, sets do
    if stop - at < 8 then
      return nil, fault("E-COUNT", at,
        "attribute_record_sets: number %d of %d needs 8 octets, %d remain", set, sets, stop - at)
    end
    local count = u16(s, at + 6)
    on_set(at, count)
    at = at + 8
    for number = 1, count do
      local behind, why = step_record(s, at, stop, number, count, set)
      if not behind then return nil, why end
      on_record(at, behind)
      at = behind
    end
  end
  return at
end

local function nothing() end

function BLOCKS.attribute_sets(s, pdu_at, block, at, stop)
  return walk_sets(s, number_at(s, pdu_at + block.at, block.width), at, stop, nothing, nothing)
end

-- Faults of a PDU -------------------------------------------------------------------------------

-- Records of ours, with their titles.
local RECORDS = {
  [OWN.haptic.type] = { OWN.haptic, "Haptic record: force model" },
  [OWN.energy.type] = { OWN.energy, "Energy account record" },
  [OWN.ownership.type] = { OWN.ownership, "Ownership record: owner of a body" },
}

-- The table of a record of ours, or nil and the reason why it cannot be read.
local function own_record(s, at, behind)
  local type = u32(s, at)
  if not RECORDS[type] then return nil end
  local own = RECORDS[type][1]
  local rule
  if behind - at < own.size then
    rule = "E-LENGTH"
  elseif own.version and s:byte(at + 7) ~= own.version then
    rule = "E-VERSION"
  else
    return own
  end
  return nil, fault(rule, at, "attribute record 0x%x of %d octets: %s", type, behind - at,
    RULES[rule])
end

-- Offset, size and name of the floats of one of our tables.
local function floats_of(own)
  local floats = {}
  for _, row in ipairs(own.fields) do
    if row[4]:sub(1, 1) == "f" then
      for _, value in ipairs({ row[2], row[3], row[1] }) do floats[#floats + 1] = value end
    end
  end
  return floats
end
for _, record in pairs(RECORDS) do record[1].floats = floats_of(record[1]) end

local function fault_in_records(s, at, sets, stop)
  local found
  walk_sets(s, sets, at, stop, nothing, function(record, behind)
    if found then return end
    local own, why = own_record(s, record, behind)
    found = why or own and not_finite(s, record, own.floats, "attribute record: ")
  end)
  return found
end

local function fault_in_blocks(s, at, pdu, stop)
  local block_at = at + pdu.size
  local strange
  for _, block in ipairs(pdu.blocks) do
    local step = BLOCKS[block.kind]
    if not step then break end  -- its records state their own lengths: not checked here
    local behind, why = step(s, at, block, block_at, stop)
    if not behind then return why end
    if block.floats then
      for record = block_at, behind - 1, block.size do
        strange = strange or not_finite(s, record, block.floats, "")
      end
    elseif block.kind == "attribute_sets" then
      strange = strange or fault_in_records(s, block_at, u16(s, at + block.at), stop)
    end
    block_at = behind
  end
  return strange
end

local function too_short(at, length, pdu)
  pdu = pdu or { name = "a header", size = HEADER_SIZE }
  return fault("E-LENGTH", at + 8, "header says %d octets, %s needs at least %d", length, pdu.name,
    pdu.size)
end

-- The first fault of a PDU whose octets are all present.
local function fault_in_body(s, at, type, length)
  local pdu = PDUS[type]
  if not pdu then
    return fault("I-UNKNOWN-TYPE", at + 2,
      "%d octets kept as they are: no field table for PDU type %d", length, type)
  end
  if length < pdu.size then return too_short(at, length, pdu) end
  local broken = fault_in_blocks(s, at, pdu, at + length)
  if broken and broken.rule ~= "W-NOT-FINITE" then return broken end
  return not_finite(s, at, pdu.floats, "") or broken
end

-- Zero octets up to the next multiple of 8, as senders put them between PDUs.
local function padding_at(s, at)
  local size = math.min(-at % 8, #s - at)
  return s:sub(at + 1, at + size):find("[^\0]") and 0 or size
end

local function is_read(version)
  return version >= OLDEST_VERSION and version <= NEWEST_VERSION
end

-- The length of an unsupported version is accepted if it leads to the end, to a supported version,
-- or to the same version.
local function leads_on(s, at, version)
  at = at + padding_at(s, at)
  return at == #s or is_read(s:byte(at + 1)) or s:byte(at + 1) == version
end

-- The PDU at `at`: its octets, type (nil without a header) and fault (nil without one).
local function read_pdu(s, at)
  local left = #s - at
  local version = s:byte(at + 1)
  local known = left > 0 and is_read(version)
  local length = left >= HEADER_SIZE and u16(s, at + 8) or 0
  local whole = length >= HEADER_SIZE and length <= left
    and (known or leads_on(s, at + length, version))
  if at > 0 and not whole and not known then
    return left, nil, fault("E-STRAY", at, "%d octets behind the last PDU", left)
  end
  if left < HEADER_SIZE then
    return left, nil, fault("E-TRUNCATED", at, "a header needs %d octets, %d remain", HEADER_SIZE,
      left)
  end
  local type = s:byte(at + 3)
  if not known then
    return whole and length or left, type, fault("E-VERSION", at,
      "protocol version %d, %d to %d are read", version, OLDEST_VERSION, NEWEST_VERSION)
  end
  if length < HEADER_SIZE then
    return left, type, too_short(at, length, PDUS[type])
  end
  if not whole then
    local inside = PDUS[type] and left < PDUS[type].size  -- its fixed part
    return left, type, fault("E-TRUNCATED", at + (inside and left or 8),
      "header says %d octets, %d remain", length, left)
  end
  return length, type, fault_in_body(s, at, type, length)
end

-- Display ---------------------------------------------------------------------------------------

local function add_own(tree, tvb, at, own)
  for _, row in ipairs(own.fields) do
    local range = tvb(at + row[2], row[3])
    if row[4] == "text" then
      tree:add(row.field, range, (range:raw():match("^[^\0]*")))
    else
      tree:add(row.field, range)
    end
  end
end

local function add_record(tree, tvb, s, at, behind)
  local own = own_record(s, at, behind)
  local item = tree:add(FIELD.record, tvb(at, behind - at))
  if own then
    item:set_text(RECORDS[own.type][2])
    return add_own(item, tvb, at, own)
  end
  item:set_text(string.format("Attribute record 0x%08x, %d octets", u32(s, at), behind - at))
  item:add(FIELD.record_type, tvb(at, 4))
  item:add(FIELD.record_length, tvb(at + 4, 2))
  if behind - at > 6 then item:add(FIELD.record_body, tvb(at + 6, behind - at - 6)) end
end

local function add_attribute(tree, tvb, s, at, stop)
  if stop - at < OWN.attribute.size then return end
  add_own(tree, tvb, at, OWN.attribute)
  local set
  walk_sets(s, u16(s, at + 30), at + OWN.attribute.size, stop, function(set_at, count)
    set = tree:add(FIELD.set, tvb(set_at, 8))
    set:set_text(string.format("Attribute record set of %s, records: %d", id_text(s, set_at),
      count))
    set:add(FIELD.set_id, tvb(set_at, 6), id_text(s, set_at))
    set:add(FIELD.set_records, tvb(set_at + 6, 2))
  end, function(record_at, behind) add_record(set, tvb, s, record_at, behind) end)
end

local EXPERIMENTAL = { presence = OWN.presence, datagram_trailer = OWN.trailer,
  cell_membership = OWN.membership, time_exchange = OWN.exchange, peers_heard = OWN.heard,
  cell_roles = OWN.roles, group_map = OWN.group_map, cell_snapshot = OWN.snapshot,
  compressed_states = OWN.compressed, unicast_frame = OWN.unicast,
  assured_record = OWN.assured }
local RECORD_OF = { cell_membership = OWN.cell, time_exchange = OWN.echo,
  peers_heard = OWN.peer, cell_roles = OWN.role, group_map = OWN.cell_group,
  assured_record = OWN.peer }

-- Messages about the owners of bodies by the kind of their Assured Record: text and the offsets of
-- its numbers in the content, which begins with the time and founder of a group.
local OWNER_MESSAGES = {
  [16] = { 24, "round %d of act %d", { 20, 1 }, { 8, 4 } },
  [17] = { 72, "act %d, attempt %d of %08x", { 8, 4 }, { 16, 4 }, { 20, 4 } },
  [18] = { 20, "vote for act %d, attempt %d of %08x", { 8, 4 }, { 12, 4 }, { 16, 4 } },
  [19] = { 20, "table %d with %d owners", { 8, 4 }, { 18, 2 } },
  [20] = { 44, "agreement on table %d", { 8, 4 } } }

local function owners_text(s, at, stop, kind)
  local row = OWNER_MESSAGES[kind]
  if not row or stop - at < row[1] then return "" end
  local numbers = {}
  for i = 3, #row do numbers[#numbers + 1] = number_at(s, at + row[i][1], row[i][2]) end
  return ": " .. string.format(row[2], table.unpack(numbers))
end

-- Types unknown to Wireshark's dissector: ours with their fields, others as octets.
local function add_experimental(tree, tvb, s, at, stop, type)
  add_own(tree, tvb, at, OWN.header)
  local pdu = PDUS[type]
  local own = pdu and stop - at >= pdu.size and EXPERIMENTAL[pdu.name]
  if not own then
    if stop - at > HEADER_SIZE then
      tree:add(FIELD.body, tvb(at + HEADER_SIZE, stop - at - HEADER_SIZE))
    end
    return
  end
  add_own(tree, tvb, at, own)
  local first = at + pdu.size
  for _, block in ipairs(pdu.blocks) do
    if block.kind ~= "records" then
      if stop <= first then return end
      local item = tree:add(FIELD.body, tvb(first, stop - first))
      if own == OWN.assured then item:append_text(owners_text(s, first, stop, s:byte(at + 17))) end
      return
    end
    local behind = BLOCKS.records(s, at, block, first, stop) or first
    for record = first, behind - 1, block.size do
      add_own(tree, tvb, record, RECORD_OF[pdu.name])
    end
    first = behind
  end
end

local FIRST_EXPERIMENTAL = 129
local ATTRIBUTE = 72

local function add_body(item, tvb, pinfo, s, at, size, type)
  if type >= FIRST_EXPERIMENTAL or not PDUS[type] then
    add_experimental(item, tvb, s, at, at + size, type)
  elseif reckon.prefs.inner and dis then
    -- It marks malformed fields in the tree itself.
    pcall(dis.call, dis, tvb(at, size):tvb(), pinfo, item)
  end
  if type == ATTRIBUTE then add_attribute(item, tvb, s, at, at + size) end
end

-- The subject or issuing entity of a PDU, as in `reckon inspect`. For a readable Attribute PDU with
-- a single set, the entity of that set.
local function id_of(s, at, size, type, rule)
  if rule == "E-VERSION" then return nil end
  local id_at = PDUS[type] and PDUS[type].id
  if type == ATTRIBUTE then
    local readable = not rule or rule == "W-NOT-FINITE"
    id_at = readable and u16(s, at + 30) == 1 and OWN.attribute.size
  end
  return id_at and size >= id_at + 6 and id_text(s, at + id_at) or nil
end

local function add_fault(item, broken)
  item:add(FIELD.rule, broken.rule):set_generated()
  item:add(FIELD.reason, broken.reason):set_generated()
  item:add(FIELD.at, broken.at):set_generated()
  item:add_proto_expert_info(EXPERT[broken.rule],
    string.format("%s at +%d: %s", broken.rule, broken.at, broken.reason))
end

-- Adds one PDU and returns its text for the Info column.
local function add_pdu(tree, tvb, pinfo, s, at, index, size, type, broken)
  local name = type and (PDU_NAMES[type] or "unknown_" .. type) or "unreadable"
  local id = type and id_of(s, at, size, type, broken and broken.rule)
  local words = id and name .. " " .. id or name
  if broken then words = words .. " " .. broken.rule end

  local range = size > 0 and tvb(at, size) or nil
  local item = range and tree:add(FIELD.pdu, range) or tree:add(FIELD.pdu)
  item:set_text(string.format("PDU %d at +%d: %s, %d octets", index, at, words, size))
  item:add(FIELD.index, index):set_generated()
  item:add(FIELD.offset, at):set_generated()
  if broken then add_fault(item, broken) end
  if not type then return words end
  item:add(FIELD.type, tvb(at + 2, 1))
  item:add(FIELD.length, tvb(at + 8, 2))
  if id then item:add(FIELD.id, id):set_generated() end
  add_body(item, tvb, pinfo, s, at, size, type)
  return words
end

local MOST_WORDS = 6  -- PDUs named in the Info column

local function show_columns(pinfo, words, count)
  local text = table.concat(words, ", ")
  if count > #words then text = text .. ", ..." end
  pinfo.cols.protocol = "DIS"
  pinfo.cols.info = count > 1 and string.format("%d PDUs: %s", count, text) or text
end

local function dissect(tvb, pinfo, root)
  local s = tvb:raw()
  local tree = root:add(reckon, tvb())
  local at, count, words = 0, 0, {}
  while true do
    local padding = padding_at(s, at)
    if padding > 0 then tree:add(FIELD.padding, tvb(at, padding)) end
    at = at + padding
    if at >= #s and count > 0 then break end
    local size, type, broken = read_pdu(s, at)
    count = count + 1
    local said = add_pdu(tree, tvb, pinfo, s, at, count, size, type, broken)
    if count <= MOST_WORDS then words[count] = said end
    at = at + size
  end
  tree:add(FIELD.count, count):set_generated()
  tree:append_text(string.format(", PDUs: %d, %d octets", count, #s))
  show_columns(pinfo, words, count)
  return tvb:len()
end

-- Selection of datagrams ------------------------------------------------------------------------

local function family_agrees(s)
  local pdu = PDUS[s:byte(3)]
  return pdu ~= nil and pdu.family == s:byte(4)
end

-- On a DIS port: a supported version, or the type and family of a PDU.
local function may_be_dis(s)
  local version = s:byte(1)
  return version >= OLDEST_VERSION and version <= NEWEST_VERSION or #s >= 4 and family_agrees(s)
end

-- On any other port: both, and a length that fits into the datagram.
local function is_dis(s)
  if #s < HEADER_SIZE or not family_agrees(s) then return false end
  local version, length = s:byte(1), u16(s, 8)
  return version >= OLDEST_VERSION and version <= NEWEST_VERSION and length <= #s
    and length >= PDUS[s:byte(3)].size
end

local before = {}  -- the earlier dissector of each port

function reckon.dissector(tvb, pinfo, root)
  if tvb:len() > 0 and may_be_dis(tvb:raw(0, math.min(tvb:len(), HEADER_SIZE))) then
    return dissect(tvb, pinfo, root)
  end
  local other = before[pinfo.match_uint]
  return other and other:call(tvb, pinfo, root) or 0
end

reckon:register_heuristic("udp", function(tvb, pinfo, root)
  if not reckon.prefs.other_ports or tvb:len() < HEADER_SIZE or not is_dis(tvb:raw()) then
    return false
  end
  dissect(tvb, pinfo, root)
  return true
end)

local function each_port(ranges, visit)
  for first, last in ranges:gmatch("(%d+)%-?(%d*)") do
    for port = tonumber(first), tonumber(last) or tonumber(first) do visit(port) end
  end
end

local taken = ""

local function take_ports()
  each_port(taken, function(port)
    udp_ports:remove(port, reckon)
    if before[port] then udp_ports:add(port, before[port]) end
  end)
  taken, before = reckon.prefs.ports, {}
  each_port(taken, function(port)
    before[port] = udp_ports:get_dissector(port)
    udp_ports:add(port, reckon)
  end)
end

function reckon.prefs_changed()
  if reckon.prefs.ports ~= taken then take_ports() end
end

take_ports()
