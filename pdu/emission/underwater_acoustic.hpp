// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Underwater Acoustic PDU (type 29): sonars and noise of an entity under water.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/emission/emission_system.hpp"

namespace reckon::pdu {

/// Speed of a propeller shaft.
struct ShaftRate {
  std::int16_t current_rpm = 0;  ///< [1/min], negative astern
  std::int16_t ordered_rpm = 0;  ///< [1/min], negative astern
  std::int32_t rate_of_change = 0;
};

/// A further passive activity and its value.
struct PassiveActivity {
  std::uint16_t parameter_index = 0;
  std::int16_t value = 0;
};

/// Head of a beam of a sonar.
struct AcousticBeam {
  static constexpr std::string_view kSystemName = "acoustic_system_name";
  static constexpr std::string_view kSystemFunction = "acoustic_function";
  static constexpr std::string_view kSystemNumber = "acoustic_id_number";

  std::uint8_t beam_data_length = 0;  ///< [4 octets]; 0 = not stated
  std::uint8_t beam_number = 0;
  std::uint16_t padding = 0;
  std::uint16_t active_emission_parameter_index = 0;
  std::uint16_t scan_pattern = 0;
  float beam_center_azimuth = 0.0F;               ///< [rad]
  float azimuthal_beamwidth = 0.0F;               ///< [rad]
  float beam_center_depression_elevation = 0.0F;  ///< [rad]
  float depression_elevation_beamwidth = 0.0F;    ///< [rad]

  [[nodiscard]] WalkResult extent(std::span<const std::byte>) const noexcept {
    return behind_head(beam_data_length == 0 ? 24 : std::size_t{beam_data_length} * 4, 24);
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    beam_data_length = static_cast<std::uint8_t>(6 + octets / 4);
    return octets / 4 * 4;
  }
};

constexpr void fields(auto& visitor, Is<AcousticBeam> auto& record) {
  visitor("beam_data_length", record.beam_data_length);
  visitor("beam_number", record.beam_number);
  visitor("padding", record.padding);
  visitor("active_emission_parameter_index", record.active_emission_parameter_index);
  visitor("scan_pattern", record.scan_pattern);
  visitor("beam_center_azimuth", record.beam_center_azimuth);
  visitor("azimuthal_beamwidth", record.azimuthal_beamwidth);
  visitor("beam_center_depression_elevation", record.beam_center_depression_elevation);
  visitor("depression_elevation_beamwidth", record.depression_elevation_beamwidth);
}
static_assert(kFixedSize<AcousticBeam> == 24);

using AcousticSystem = EmissionSystem<AcousticBeam>;
static_assert(kFixedSize<AcousticSystem> == 20);

struct UnderwaterAcoustic {
  static constexpr PduType kPduType = PduType::underwater_acoustic;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::distributed_emission_regeneration;
  using Shafts = Records<ShaftRate, std::uint8_t>;
  using AdditionalPassiveActivities = Records<PassiveActivity, std::uint8_t>;

  PduHeader header = header_of<UnderwaterAcoustic>();
  EntityId emitting_entity_id;
  EventId event_id;
  std::uint8_t state_change_update_indicator = 0;
  std::uint8_t padding = 0;
  std::uint16_t passive_parameter_index = 0;
  std::uint8_t propulsion_plant_configuration = 0;
  std::span<const std::byte> shafts;  ///< read with records_of<ShaftRate>
  std::span<const std::byte>
      additional_passive_activities;  ///< read with records_of<PassiveActivity>
  SizedRecords<AcousticSystem, std::uint8_t> emitter_systems;
};

constexpr void fields(auto& visitor, Is<UnderwaterAcoustic> auto& pdu) {
  visitor("header", pdu.header);
  visitor("emitting_entity_id", pdu.emitting_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("state_change_update_indicator", pdu.state_change_update_indicator);
  visitor("padding", pdu.padding);
  visitor("passive_parameter_index", pdu.passive_parameter_index);
  visitor("propulsion_plant_configuration", pdu.propulsion_plant_configuration);
  visitor.count("number_of_shafts", pdu.shafts, UnderwaterAcoustic::Shafts{});
  visitor.count("number_of_additional_passive_activities", pdu.additional_passive_activities,
                UnderwaterAcoustic::AdditionalPassiveActivities{});
  visitor("number_of_emitter_systems", pdu.emitter_systems.count);
  visitor.records("shafts", pdu.shafts, UnderwaterAcoustic::Shafts{});
  visitor.records("additional_passive_activities", pdu.additional_passive_activities,
                  UnderwaterAcoustic::AdditionalPassiveActivities{});
  visitor.walked("emitter_systems", pdu.emitter_systems);
}
static_assert(kFixedSize<UnderwaterAcoustic> == 32);

}  // namespace reckon::pdu
