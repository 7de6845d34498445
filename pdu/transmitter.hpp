// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transmitter PDU (type 25): a radio transmitter, its antenna and its modulation.
#pragma once

#include <cstdint>
#include <type_traits>

#include "pdu/codec.hpp"
#include "pdu/octet_block.hpp"
#include "pdu/records.hpp"
#include "pdu/standard_variable_record.hpp"

namespace reckon::pdu {

/// How a radio modulates (UID 155 and those it leads to).
struct ModulationType {
  std::uint16_t spread_spectrum = 0;
  std::uint16_t major_modulation = 0;
  std::uint16_t detail = 0;
  std::uint16_t radio_system = 0;
};

template <typename Visitor, Is<ModulationType> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("spread_spectrum", record.spread_spectrum);
  visitor("major_modulation", record.major_modulation);
  visitor("detail", record.detail);
  visitor("radio_system", record.radio_system);
}
static_assert(kFixedSize<ModulationType> == 8);

struct Transmitter {
  static constexpr PduType kPduType = PduType::transmitter;
  static constexpr ProtocolFamily kProtocolFamily = ProtocolFamily::radio_communications;

  PduHeader header = header_of<Transmitter>();
  EntityId radio_reference_id;
  std::uint16_t radio_number = 0;
  EntityType radio_type;
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

template <typename Visitor, Is<Transmitter> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("radio_reference_id", pdu.radio_reference_id);
  visitor("radio_number", pdu.radio_number);
  visitor("radio_type", pdu.radio_type);
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
  visitor.walked("modulation_parameters", pdu.modulation_parameters);
  visitor.walked("antenna_pattern", pdu.antenna_pattern);
  // DIS 5 and 6 have no such records: their number is padding there.
  if (pdu.header.protocol_version >= 7) {
    visitor.walked("variable_transmitter_parameters", pdu.variable_transmitter_parameters);
  } else if constexpr (!std::is_const_v<Pdu>) {
    pdu.variable_transmitter_parameters.bytes = {};
  }
}
static_assert(kFixedSize<Transmitter> == 104);

}  // namespace reckon::pdu
