// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transmitter PDU (type 25): a radio transmitter, its antenna and its modulation.
#pragma once

#include <cstdint>
#include <string_view>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"

namespace reckon::pdu {

/// Modulation of a radio (UID 155 and the lists that it refers to).
struct ModulationType {
  std::uint16_t spread_spectrum = 0;
  std::uint16_t major_modulation = 0;
  std::uint16_t detail = 0;
  std::uint16_t radio_system = 0;
};
static_assert(kFixedSize<ModulationType> == 8);

/// Type of a radio in DIS 5 and 6.
struct RadioEntityType {
  EntityKind kind = EntityKind::other;
  EntityDomain domain = EntityDomain::other;
  std::uint16_t country = 0;
  std::uint8_t category = 0;
  std::uint8_t nomenclature_version = 0;
  std::uint16_t nomenclature = 0;
};
static_assert(kFixedSize<RadioEntityType> == kFixedSize<EntityType>);

/// Antenna pattern of type kBeam.
struct BeamAntennaPattern {
  static constexpr std::uint16_t kBeam = 1;

  EulerAngles beam_direction;         ///< [rad]
  float azimuth_beamwidth = 0.0F;     ///< [rad]
  float elevation_beamwidth = 0.0F;   ///< [rad]
  std::uint8_t reference_system = 0;  ///< UID 168
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  float ez = 0.0F;
  float ex = 0.0F;
  float phase = 0.0F;  ///< [rad]
  std::uint32_t padding_3 = 0;
};
static_assert(kFixedSize<BeamAntennaPattern> == 40);

/// Modulation parameters of HAVE QUICK radios (systems 2 and 3).
struct HaveQuickParameters {
  std::uint16_t net_id = 0;
  std::uint16_t mwod_index = 0;
  std::uint16_t reserved_1 = 0;
  std::uint8_t reserved_2 = 0;
  std::uint8_t reserved_3 = 0;
  std::uint32_t time_of_day = 0;
  std::uint32_t padding = 0;
};
static_assert(kFixedSize<HaveQuickParameters> == 16);

/// Modulation parameters of CCTT SINCGARS radios (system 6).
struct SincgarsParameters {
  std::uint16_t frequency_hopping_network_id = 0;
  std::uint16_t frequency_set_id = 0;
  std::uint16_t frequency_lockout_set_id = 0;
  std::uint8_t start_of_message = 0;
  std::uint8_t reserved = 0;
  std::uint32_t sync_time_offset = 0;  ///< [s]
  std::uint16_t transmission_security_key = 0;
  std::uint8_t clear_channel = 0;
  std::uint8_t padding = 0;
};
static_assert(kFixedSize<SincgarsParameters> == 16);

/// Modulation parameters of JTIDS and MIDS terminals (system 8).
struct JtidsParameters {
  std::uint8_t time_slot_allocation_mode = 0;
  std::uint8_t transmitting_terminal_primary_mode = 0;
  std::uint8_t transmitting_terminal_secondary_mode = 0;
  std::uint8_t synchronization_state = 0;
  std::uint32_t network_synchronization_id = 0;
};
static_assert(kFixedSize<JtidsParameters> == 8);

struct Transmitter {
  static constexpr PduType kPduType = PduType::transmitter;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<Transmitter>();
  EntityId radio_reference_id;
  std::uint16_t radio_number = 0;
  EntityType radio_type;              ///< from DIS 7 on
  RadioEntityType radio_entity_type;  ///< up to DIS 6
  std::uint8_t transmit_state = 0;
  std::uint8_t input_source = 0;
  SizedRecords<StandardVariableRecord, std::uint16_t> variable_transmitter_parameters;
  WorldCoordinates antenna_location;       ///< [m]
  Vector3Float relative_antenna_location;  ///< body axes of the entity [m]
  std::uint16_t antenna_pattern_type = 0;
  OctetBlock<std::uint16_t> antenna_pattern;
  std::uint64_t frequency = 0;                ///< centre [Hz]
  float transmit_frequency_bandwidth = 0.0F;  ///< [Hz]
  float power = 0.0F;                         ///< [dBm]
  ModulationType modulation_type;
  std::uint16_t crypto_system = 0;
  std::uint16_t crypto_key_id = 0;
  OctetBlock<std::uint8_t> modulation_parameters;
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
};

/// Octets, or for an inspecting visitor the record of a known radio system.
template <typename Visitor, Is<Transmitter> Pdu>
constexpr void modulation_parameters_field(Visitor& visitor, Pdu& pdu) {
  constexpr std::string_view kName = "modulation_parameters";
  bool shown = false;
  if constexpr (Looks<Visitor, Pdu>) {
    switch (pdu.modulation_type.radio_system) {
      case 2:
      case 3:
        shown = block_as<HaveQuickParameters>(visitor, kName, pdu.modulation_parameters);
        break;
      case 6:
        shown = block_as<SincgarsParameters>(visitor, kName, pdu.modulation_parameters);
        break;
      case 8:
        shown = block_as<JtidsParameters>(visitor, kName, pdu.modulation_parameters);
        break;
      default:
        break;
    }
  }
  if (!shown) visitor.walked(kName, pdu.modulation_parameters);
}

template <typename Visitor, Is<Transmitter> Pdu>
constexpr void antenna_pattern_field(Visitor& visitor, Pdu& pdu) {
  constexpr std::string_view kName = "antenna_pattern";
  bool shown = false;
  if constexpr (Looks<Visitor, Pdu>) {
    shown = pdu.antenna_pattern_type == BeamAntennaPattern::kBeam &&
            block_as<BeamAntennaPattern>(visitor, kName, pdu.antenna_pattern);
  }
  if (!shown) visitor.walked(kName, pdu.antenna_pattern);
}

constexpr void fields(auto& visitor, Is<Transmitter> auto& pdu) {
  visitor("header", pdu.header);
  visitor("radio_reference_id", pdu.radio_reference_id);
  visitor("radio_number", pdu.radio_number);
  const bool dis6 = is_before_dis7(pdu.header);
  dis6 ? visitor("radio_entity_type", pdu.radio_entity_type)
       : visitor("radio_type", pdu.radio_type);
  visitor("transmit_state", pdu.transmit_state);
  visitor("input_source", pdu.input_source);
  visitor("number_of_variable_transmitter_parameters", pdu.variable_transmitter_parameters.count);
  visitor("antenna_location", pdu.antenna_location);
  visitor("relative_antenna_location", pdu.relative_antenna_location);
  visitor("antenna_pattern_type", pdu.antenna_pattern_type);
  visitor("length_of_antenna_pattern", pdu.antenna_pattern.count);
  visitor("frequency", pdu.frequency);
  visitor("transmit_frequency_bandwidth", pdu.transmit_frequency_bandwidth);
  visitor("power", pdu.power);
  visitor("modulation_type", pdu.modulation_type);
  visitor("crypto_system", pdu.crypto_system);
  visitor("crypto_key_id", pdu.crypto_key_id);
  visitor("length_of_modulation_parameters", pdu.modulation_parameters.count);
  visitor("padding_1", pdu.padding_1);
  visitor("padding_2", pdu.padding_2);
  modulation_parameters_field(visitor, pdu);
  antenna_pattern_field(visitor, pdu);
  // DIS 5 and 6 have no such records: the field of their number is padding.
  walked_when(!dis6, visitor, "variable_transmitter_parameters",
              pdu.variable_transmitter_parameters);
}
static_assert(kFixedSize<Transmitter> == 104);

}  // namespace reckon::pdu
