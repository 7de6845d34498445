// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// IFF PDU (type 28, identification friend or foe): basic system data and further layers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/octet_block.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/codec/sized_records.hpp"
#include "reckon/pdu/codec/standard_variable_record.hpp"
#include "reckon/pdu/emission/emission_system.hpp"

namespace reckon::pdu {

/// Head of layer 2 and above.
struct IffLayer {
  std::uint8_t layer_number = 0;
  std::uint8_t layer_specific_information = 0;
  std::uint16_t length = 0;  ///< head and body [octets]

  [[nodiscard]] WalkResult extent(std::span<const std::byte>) const noexcept {
    return behind_head(length, 4);
  }
  [[nodiscard]] std::size_t claim(std::size_t octets) noexcept {
    length = static_cast<std::uint16_t>(4 + octets);
    return octets;
  }
};

constexpr void fields(auto& visitor, Is<IffLayer> auto& record) {
  visitor("layer_number", record.layer_number);
  visitor("layer_specific_information", record.layer_specific_information);
  visitor("length", record.length);
}
static_assert(kFixedSize<IffLayer> == 4);

/// Layer 2: emission data. Fundamental parameter data records follow it.
struct IffEmission {
  BeamData scan;
  std::uint8_t operational_parameter_1 = 0;
  std::uint8_t operational_parameter_2 = 0;
  std::uint16_t number_of_fundamental_parameters = 0;
};
static_assert(kFixedSize<IffEmission> == 24);

struct IffFundamentalParameters {
  float effective_radiated_power = 0.0F;  ///< [dBm]
  float frequency = 0.0F;                 ///< [Hz]
  float pulse_group_repetition_frequency = 0.0F;
  float pulse_width = 0.0F;  ///< [us]
  std::uint32_t burst_length = 0;
  std::uint8_t applicable_modes = 0;
  std::array<std::uint8_t, 3> system_specific_data{};  ///< padding before DIS 7
};
static_assert(kFixedSize<IffFundamentalParameters> == 24);

/// Layer 5: data records of one category that apply to `applicable_layers`.
struct IffDataLayer {
  SimulationAddress reporting_simulation;
  std::uint16_t padding_1 = 0;
  std::uint8_t applicable_layers = 0;
  std::uint8_t data_category = 0;
  std::uint16_t padding_2 = 0;
  std::uint16_t number_of_data_records = 0;
};
static_assert(kFixedSize<IffDataLayer> == 12);

/// Layer 3: Mode 5. The basic data have the layout of a transponder or of an interrogator; the
/// layer does not state which.
struct IffMode5Layer {
  SimulationAddress reporting_simulation;
  std::array<std::uint8_t, 16> mode_5_basic_data{};
  std::uint16_t padding = 0;
  std::uint16_t number_of_data_records = 0;
};
static_assert(kFixedSize<IffMode5Layer> == 24);

/// Layer 4: Mode S of an interrogator, which has only padding behind its levels.
struct IffModeSInterrogatorLayer {
  SimulationAddress reporting_simulation;
  std::uint8_t interrogator_status = 0;
  std::uint8_t padding_1 = 0;
  std::uint8_t levels_present = 0;
  std::uint8_t padding_2 = 0;
  std::array<std::uint8_t, 20> padding_3{};
  std::uint16_t padding_4 = 0;
  std::uint16_t number_of_data_records = 0;
};
static_assert(kFixedSize<IffModeSInterrogatorLayer> == 32);

/// Layer 4: Mode S of a transponder.
struct IffModeSTransponderLayer {
  SimulationAddress reporting_simulation;
  std::uint16_t transponder_status = 0;
  std::uint8_t levels_present = 0;
  std::uint8_t aircraft_present_domain = 0;
  std::array<char, 8> aircraft_identification{};
  std::uint32_t aircraft_address = 0;
  std::uint8_t aircraft_identification_type = 0;
  std::uint8_t dap_source = 0;
  std::uint16_t altitude = 0;
  std::uint8_t capability_report = 0;
  std::uint8_t padding_1 = 0;
  std::uint16_t padding_2 = 0;
  std::uint16_t padding_3 = 0;
  std::uint16_t number_of_data_records = 0;
};
static_assert(kFixedSize<IffModeSTransponderLayer> == 32);

/// Whether the body of a layer 4 has zeros in the octets where a transponder identifies its
/// aircraft.
[[nodiscard]] inline bool is_mode_s_interrogator(std::span<const std::byte> body) noexcept {
  constexpr std::size_t kAircraft = 8, kEnd = 28;
  return body.size() >= kEnd && std::ranges::all_of(body.subspan(kAircraft, kEnd - kAircraft),
                                                    [](std::byte o) { return o == std::byte{0}; });
}

/// Visits a head and its data records. False if they do not fill the body exactly.
template <typename Head, typename Visitor>
bool show_iff_layer(Visitor& visitor, std::span<const std::byte> body) {
  Head head;
  if (!load_record(body, head)) return false;
  const std::span<const std::byte> behind = body.subspan(kFixedSize<Head>);
  using DataRecords = SizedRecords<StandardVariableRecord, std::uint16_t>;
  const WalkResult walked = DataRecords::walk(head.number_of_data_records, behind);
  if (walked.error != DecodeError::none || walked.size != behind.size()) return false;
  fields(visitor, std::as_const(head));
  visitor.walked("data_records", DataRecords{head.number_of_data_records, behind});
  return true;
}

bool show_iff_emission(auto& visitor, std::span<const std::byte> body) {
  IffEmission head;
  if (!load_record(body, head)) return false;
  const std::span<const std::byte> behind = body.subspan(kFixedSize<IffEmission>);
  if (behind.size() != head.number_of_fundamental_parameters * kFixedSize<IffFundamentalParameters>)
    return false;
  fields(visitor, std::as_const(head));
  visitor.records("fundamental_parameters", behind,
                  Records<IffFundamentalParameters, std::uint16_t>{});
  return true;
}

bool show_iff_mode_s(auto& visitor, std::span<const std::byte> body) {
  return is_mode_s_interrogator(body) ? show_iff_layer<IffModeSInterrogatorLayer>(visitor, body)
                                      : show_iff_layer<IffModeSTransponderLayer>(visitor, body);
}

/// Visits layers 2 to 5 field by field if the fields fill the layer exactly, all other bodies as
/// octets.
void parts(auto& visitor, const IffLayer& layer, std::span<const std::byte> body) {
  const bool shown = (layer.layer_number == 2 && show_iff_emission(visitor, body)) ||
                     (layer.layer_number == 3 && show_iff_layer<IffMode5Layer>(visitor, body)) ||
                     (layer.layer_number == 4 && show_iff_mode_s(visitor, body)) ||
                     (layer.layer_number == 5 && show_iff_layer<IffDataLayer>(visitor, body));
  if (!shown) visitor.walked("body", RestOfPdu{body});
}

struct Iff {
  static constexpr PduType kPduType = PduType::iff;
  static constexpr ProtocolFamily kProtocolFamily =
      ProtocolFamily::distributed_emission_regeneration;

  PduHeader header = header_of<Iff>();
  EntityId emitting_entity_id;
  EventId event_id;
  Vector3Float relative_antenna_location;  ///< body axes of the emitting entity [m]
  std::uint16_t system_type = 0;
  std::uint16_t system_name = 0;
  std::uint8_t system_mode = 0;
  std::uint8_t change_options = 0;
  std::uint8_t system_designator = 0;     ///< from DIS 7 on
  std::uint8_t system_specific_data = 0;  ///< from DIS 7 on
  std::uint16_t padding = 0;              ///< before DIS 7, instead of the two fields above
  std::uint8_t system_status = 0;
  std::uint8_t alternate_parameter_4 = 0;
  std::uint8_t information_layers = 0;  ///< which layers are present
  std::uint8_t modifier = 0;
  std::uint16_t parameter_1 = 0;
  std::uint16_t parameter_2 = 0;
  std::uint16_t parameter_3 = 0;
  std::uint16_t parameter_4 = 0;
  std::uint16_t parameter_5 = 0;
  std::uint16_t parameter_6 = 0;
  SizedRecordsToEnd<IffLayer> layers;
};

constexpr void fields(auto& visitor, Is<Iff> auto& pdu) {
  visitor("header", pdu.header);
  visitor("emitting_entity_id", pdu.emitting_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("relative_antenna_location", pdu.relative_antenna_location);
  visitor("system_type", pdu.system_type);
  visitor("system_name", pdu.system_name);
  visitor("system_mode", pdu.system_mode);
  visitor("change_options", pdu.change_options);
  if (is_before_dis7(pdu.header)) {
    visitor("padding", pdu.padding);
  } else {
    visitor("system_designator", pdu.system_designator);
    visitor("system_specific_data", pdu.system_specific_data);
  }
  visitor("system_status", pdu.system_status);
  visitor("alternate_parameter_4", pdu.alternate_parameter_4);
  visitor("information_layers", pdu.information_layers);
  visitor("modifier", pdu.modifier);
  visitor("parameter_1", pdu.parameter_1);
  visitor("parameter_2", pdu.parameter_2);
  visitor("parameter_3", pdu.parameter_3);
  visitor("parameter_4", pdu.parameter_4);
  visitor("parameter_5", pdu.parameter_5);
  visitor("parameter_6", pdu.parameter_6);
  visitor.walked("layers", pdu.layers);
}
static_assert(kFixedSize<Iff> == 60);

}  // namespace reckon::pdu
