// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Electromagnetic Emission PDU (type 23): radars and jammers of an entity, with their beams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"
#include "pdu/sized_records.hpp"

namespace reckon::pdu {

/// An entity that a beam tracks or jams.
struct TrackJamTarget {
  EntityId entity_id;
  std::uint8_t emitter_number = 0;
  std::uint8_t beam_number = 0;
};

template <typename Visitor, Is<TrackJamTarget> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("entity_id", record.entity_id);
  visitor("emitter_number", record.emitter_number);
  visitor("beam_number", record.beam_number);
}
static_assert(kFixedSize<TrackJamTarget> == 8);

/// Head of a beam; its targets follow.
struct EmitterBeam {
  std::uint8_t beam_data_length = 0;  ///< head and targets [4 octets]; 0 = too long to say
  std::uint8_t beam_number = 0;
  std::uint16_t beam_parameter_index = 0;
  float frequency = 0.0F;                   ///< [Hz]
  float frequency_range = 0.0F;             ///< [Hz]
  float effective_radiated_power = 0.0F;    ///< [dBm]
  float pulse_repetition_frequency = 0.0F;  ///< [Hz]
  float pulse_width = 0.0F;                 ///< [us]
  float beam_azimuth_center = 0.0F;         ///< [rad]
  float beam_azimuth_sweep = 0.0F;          ///< half of it [rad]
  float beam_elevation_center = 0.0F;       ///< [rad]
  float beam_elevation_sweep = 0.0F;        ///< half of it [rad]
  float beam_sweep_sync = 0.0F;             ///< [%]
  std::uint8_t beam_function = 0;
  std::uint8_t number_of_targets = 0;
  std::uint8_t high_density_track_jam = 0;
  std::uint8_t beam_status = 0;  ///< padding in DIS 5 and 6
  std::uint8_t jamming_technique_kind = 0;
  std::uint8_t jamming_technique_category = 0;
  std::uint8_t jamming_technique_subcategory = 0;
  std::uint8_t jamming_technique_specific = 0;

  [[nodiscard]] WalkResult extent(std::span<const std::byte> behind) const noexcept;
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    number_of_targets = static_cast<std::uint8_t>(octets / 8);
    beam_data_length = static_cast<std::uint8_t>(13 + 2 * number_of_targets);
    return std::size_t{number_of_targets} * 8;
  }
};

template <typename Visitor, Is<EmitterBeam> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("beam_data_length", record.beam_data_length);
  visitor("beam_number", record.beam_number);
  visitor("beam_parameter_index", record.beam_parameter_index);
  visitor("frequency", record.frequency);
  visitor("frequency_range", record.frequency_range);
  visitor("effective_radiated_power", record.effective_radiated_power);
  visitor("pulse_repetition_frequency", record.pulse_repetition_frequency);
  visitor("pulse_width", record.pulse_width);
  visitor("beam_azimuth_center", record.beam_azimuth_center);
  visitor("beam_azimuth_sweep", record.beam_azimuth_sweep);
  visitor("beam_elevation_center", record.beam_elevation_center);
  visitor("beam_elevation_sweep", record.beam_elevation_sweep);
  visitor("beam_sweep_sync", record.beam_sweep_sync);
  visitor("beam_function", record.beam_function);
  visitor("number_of_targets", record.number_of_targets);
  visitor("high_density_track_jam", record.high_density_track_jam);
  visitor("beam_status", record.beam_status);
  visitor("jamming_technique_kind", record.jamming_technique_kind);
  visitor("jamming_technique_category", record.jamming_technique_category);
  visitor("jamming_technique_subcategory", record.jamming_technique_subcategory);
  visitor("jamming_technique_specific", record.jamming_technique_specific);
}
static_assert(kFixedSize<EmitterBeam> == 52);

inline WalkResult EmitterBeam::extent(std::span<const std::byte> behind) const noexcept {
  const std::size_t targets = number_of_targets * kFixedSize<TrackJamTarget>;
  if (targets > behind.size()) return {0, DecodeError::count};
  if (beam_data_length == 0) return {targets, DecodeError::none};
  const WalkResult said = behind_head(std::size_t{beam_data_length} * 4, 52);
  if (said.error == DecodeError::none && said.size < targets) return {0, DecodeError::record};
  return said;
}

template <typename Visitor>
void parts(Visitor& visitor, const EmitterBeam& beam, std::span<const std::byte> body) {
  const std::size_t size = beam.number_of_targets * kFixedSize<TrackJamTarget>;
  visitor.records("track_jam_targets", body.first(size), Records<TrackJamTarget, std::uint8_t>{});
}

/// Head of an emitter system; its beams follow.
struct EmitterSystem {
  std::uint8_t system_data_length = 0;  ///< head and beams [4 octets]; 0 = too long to say
  std::uint8_t number_of_beams = 0;
  std::uint16_t padding = 0;
  std::uint16_t emitter_name = 0;
  std::uint8_t emitter_function = 0;
  std::uint8_t emitter_number = 0;
  Vector3Float location;  ///< body axes of the emitting entity [m]

  [[nodiscard]] WalkResult extent(std::span<const std::byte> behind) const noexcept {
    return extent_by_parts<EmitterBeam>(system_data_length, 20, number_of_beams, behind);
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    number_of_beams = 0;
    system_data_length = static_cast<std::uint8_t>(5 + octets / 4);
    return octets / 4 * 4;
  }
};

template <typename Visitor, Is<EmitterSystem> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("system_data_length", record.system_data_length);
  visitor("number_of_beams", record.number_of_beams);
  visitor("padding", record.padding);
  visitor("emitter_name", record.emitter_name);
  visitor("emitter_function", record.emitter_function);
  visitor("emitter_number", record.emitter_number);
  visitor("location", record.location);
}
static_assert(kFixedSize<EmitterSystem> == 20);

template <typename Visitor>
void parts(Visitor& visitor, const EmitterSystem& system, std::span<const std::byte> body) {
  visitor.walked("beams", SizedRecords<EmitterBeam, std::uint8_t>{system.number_of_beams, body});
}

struct ElectromagneticEmission {
  static constexpr PduType kPduType = PduType::electromagnetic_emission;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::distributed_emission_regeneration;

  PduHeader header = header_of<ElectromagneticEmission>();
  EntityId emitting_entity_id;
  EventId event_id;
  std::uint8_t state_update_indicator = 0;
  SizedRecords<EmitterSystem, std::uint8_t> systems;
  std::uint16_t padding = 0;
};

template <typename Visitor, Is<ElectromagneticEmission> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("emitting_entity_id", pdu.emitting_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("state_update_indicator", pdu.state_update_indicator);
  visitor("number_of_systems", pdu.systems.count);
  visitor("padding", pdu.padding);
  visitor.walked("systems", pdu.systems);
}
static_assert(kFixedSize<ElectromagneticEmission> == 28);

}  // namespace reckon::pdu
