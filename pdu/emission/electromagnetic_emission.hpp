// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Electromagnetic Emission PDU (type 23): radars and jammers of an entity, with their beams.
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

/// An entity that a beam tracks or jams.
struct TrackJamTarget {
  EntityId entity_id;
  std::uint8_t emitter_number = 0;
  std::uint8_t beam_number = 0;
};
static_assert(kFixedSize<TrackJamTarget> == 8);

/// Jamming technique of a beam in DIS 7.
struct JammingTechnique {
  std::uint8_t beam_status = 0;
  std::uint8_t kind = 0;
  std::uint8_t category = 0;
  std::uint8_t subcategory = 0;
  std::uint8_t specific = 0;
};

constexpr void fields(auto& visitor, Is<JammingTechnique> auto& record) {
  visitor("beam_status", record.beam_status);
  visitor("jamming_technique_kind", record.kind);
  visitor("jamming_technique_category", record.category);
  visitor("jamming_technique_subcategory", record.subcategory);
  visitor("jamming_technique_specific", record.specific);
}

/// The same five octets in DIS 5 and 6.
struct JammingModeSequence {
  std::uint8_t padding = 0;
  std::uint32_t jamming_mode_sequence = 0;
};

/// Head of a beam; its targets follow.
template <typename Jamming>
struct BasicEmitterBeam {
  static constexpr std::string_view kSystemName = "emitter_name";
  static constexpr std::string_view kSystemFunction = "emitter_function";
  static constexpr std::string_view kSystemNumber = "emitter_number";

  std::uint8_t beam_data_length = 0;  ///< head and targets [4 octets]; 0 = too long for the field
  std::uint8_t beam_number = 0;
  std::uint16_t beam_parameter_index = 0;
  float frequency = 0.0F;                   ///< [Hz]
  float frequency_range = 0.0F;             ///< [Hz]
  float effective_radiated_power = 0.0F;    ///< [dBm]
  float pulse_repetition_frequency = 0.0F;  ///< [Hz]
  float pulse_width = 0.0F;                 ///< [us]
  BeamData scan;
  std::uint8_t beam_function = 0;
  std::uint8_t number_of_targets = 0;
  std::uint8_t high_density_track_jam = 0;
  Jamming jamming;

  [[nodiscard]] WalkResult extent(std::span<const std::byte> behind) const noexcept {
    const std::size_t targets = number_of_targets * kFixedSize<TrackJamTarget>;
    if (targets > behind.size()) return {0, DecodeError::count};
    if (beam_data_length == 0) return {targets, DecodeError::none};
    const WalkResult said = behind_head(std::size_t{beam_data_length} * 4, 52);
    if (said.error == DecodeError::none && said.size < targets) return {0, DecodeError::record};
    return said;
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    number_of_targets = static_cast<std::uint8_t>(octets / 8);
    beam_data_length = static_cast<std::uint8_t>(13 + 2 * number_of_targets);
    return std::size_t{number_of_targets} * 8;
  }
};

using EmitterBeam = BasicEmitterBeam<JammingTechnique>;
using EmitterBeamOfDis6 = BasicEmitterBeam<JammingModeSequence>;

constexpr void fields(auto& visitor, IsOneOf<EmitterBeam, EmitterBeamOfDis6> auto& record) {
  visitor("beam_data_length", record.beam_data_length);
  visitor("beam_number", record.beam_number);
  visitor("beam_parameter_index", record.beam_parameter_index);
  visitor("frequency", record.frequency);
  visitor("frequency_range", record.frequency_range);
  visitor("effective_radiated_power", record.effective_radiated_power);
  visitor("pulse_repetition_frequency", record.pulse_repetition_frequency);
  visitor("pulse_width", record.pulse_width);
  fields(visitor, record.scan);
  visitor("beam_function", record.beam_function);
  visitor("number_of_targets", record.number_of_targets);
  visitor("high_density_track_jam", record.high_density_track_jam);
  fields(visitor, record.jamming);
}
static_assert(kFixedSize<EmitterBeam> == 52);
static_assert(kFixedSize<EmitterBeamOfDis6> == 52);

template <typename Visitor, typename Jamming>
void parts(Visitor& visitor, const BasicEmitterBeam<Jamming>& beam,
           std::span<const std::byte> body) {
  const std::size_t size = beam.number_of_targets * kFixedSize<TrackJamTarget>;
  visitor.records("track_jam_targets", body.first(size), Records<TrackJamTarget, std::uint8_t>{});
}

using EmitterSystem = EmissionSystem<EmitterBeam>;
using EmitterSystemOfDis6 = EmissionSystem<EmitterBeamOfDis6>;
static_assert(kFixedSize<EmitterSystem> == 20);

struct ElectromagneticEmission {
  static constexpr PduType kPduType = PduType::electromagnetic_emission;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::distributed_emission_regeneration;

  PduHeader header = header_of<ElectromagneticEmission>();
  EntityId emitting_entity_id;
  EventId event_id;
  std::uint8_t state_update_indicator = 0;
  SizedRecords<EmitterSystem, std::uint8_t> systems;             ///< from DIS 7 on
  SizedRecords<EmitterSystemOfDis6, std::uint8_t> dis6_systems;  ///< up to DIS 6
  std::uint16_t padding = 0;
};

constexpr void fields(auto& visitor, Is<ElectromagneticEmission> auto& pdu) {
  visitor("header", pdu.header);
  visitor("emitting_entity_id", pdu.emitting_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("state_update_indicator", pdu.state_update_indicator);
  const bool dis6 = is_before_dis7(pdu.header);
  dis6 ? visitor("number_of_systems", pdu.dis6_systems.count)
       : visitor("number_of_systems", pdu.systems.count);
  visitor("padding", pdu.padding);
  walked_when(!dis6, visitor, "systems", pdu.systems);
  walked_when(dis6, visitor, "systems", pdu.dis6_systems);
}
static_assert(kFixedSize<ElectromagneticEmission> == 28);

}  // namespace reckon::pdu
