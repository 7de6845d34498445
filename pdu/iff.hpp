// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// IFF PDU (type 28): identification friend or foe: basic system data and further layers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pdu/codec.hpp"
#include "pdu/records.hpp"
#include "pdu/sized_records.hpp"

namespace reckon::pdu {

/// Head of layer 2 and above; the body is kept as octets.
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

template <typename Visitor, Is<IffLayer> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("layer_number", record.layer_number);
  visitor("layer_specific_information", record.layer_specific_information);
  visitor("length", record.length);
}
static_assert(kFixedSize<IffLayer> == 4);

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
  std::uint8_t system_designator = 0;
  std::uint8_t system_specific_data = 0;
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

template <typename Visitor, Is<Iff> Pdu>
constexpr void fields(Visitor& visitor, Pdu& pdu) {
  visitor("header", pdu.header);
  visitor("emitting_entity_id", pdu.emitting_entity_id);
  visitor("event_id", pdu.event_id);
  visitor("relative_antenna_location", pdu.relative_antenna_location);
  visitor("system_type", pdu.system_type);
  visitor("system_name", pdu.system_name);
  visitor("system_mode", pdu.system_mode);
  visitor("change_options", pdu.change_options);
  visitor("system_designator", pdu.system_designator);
  visitor("system_specific_data", pdu.system_specific_data);
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
