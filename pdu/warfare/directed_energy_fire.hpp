// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Directed Energy Fire PDU (type 68): a beam weapon fires.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"

namespace reckon::pdu {

struct DirectedEnergyFire {
  static constexpr PduType kPduType = PduType::directed_energy_fire;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::warfare;

  PduHeader header = header_of<DirectedEnergyFire>();
  EntityId firing_entity_id;
  EventId event_id;
  EntityType munition_type;
  ClockTime shot_start_time;
  float cumulative_shot_time = 0.0F;       ///< [s]
  Vector3Float aperture_emitter_location;  ///< body axes of the firing entity [m]
  float aperture_diameter = 0.0F;          ///< [m]
  float wavelength = 0.0F;                 ///< [m]
  std::uint32_t padding_1 = 0;
  float pulse_repetition_frequency = 0.0F;  ///< [Hz]
  float pulse_width = 0.0F;                 ///< [s]
  std::uint16_t flags = 0;
  std::uint8_t pulse_shape = 0;
  std::uint8_t padding_2 = 0;
  std::uint32_t padding_3 = 0;
  std::uint16_t padding_4 = 0;
  SizedRecords<StandardVariableRecord, std::uint16_t> directed_energy_records;
};

constexpr void fields(auto& visitor, Is<DirectedEnergyFire> auto& pdu) {
  visitor("header", pdu.header);
  visitor("firing_entity_id", pdu.firing_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("munition_type", pdu.munition_type);
  visitor("shot_start_time", pdu.shot_start_time);
  visitor("cumulative_shot_time", pdu.cumulative_shot_time);
  visitor("aperture_emitter_location", pdu.aperture_emitter_location);
  visitor("aperture_diameter", pdu.aperture_diameter);
  visitor("wavelength", pdu.wavelength);
  visitor("padding_1", pdu.padding_1);
  visitor("pulse_repetition_frequency", pdu.pulse_repetition_frequency);
  visitor("pulse_width", pdu.pulse_width);
  visitor("flags", pdu.flags);
  visitor("pulse_shape", pdu.pulse_shape);
  visitor("padding_2", pdu.padding_2);
  visitor("padding_3", pdu.padding_3);
  visitor("padding_4", pdu.padding_4);
  visitor("number_of_directed_energy_records", pdu.directed_energy_records.count);
  visitor.walked("directed_energy_records", pdu.directed_energy_records);
}
static_assert(kFixedSize<DirectedEnergyFire> == 88);

}  // namespace reckon::pdu
